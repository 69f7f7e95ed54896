#!/bin/sh
# OpenMVS' surface from given cameras: openmvs.sh PHOTOS MODEL MASKS MESH RESOLUTION
# PHOTOS as `tailor show photos` writes them, MODEL cameras as COLMAP's text model, MASKS a PNG a photo; the mesh
# goes to MESH in the model's frame and millimetres.
set -eu
photos=$1 model=$2 masks=$3 mesh=$4 resolution=$5
# OpenMVS takes masks named NAME.mask.png, 0 for what is to be left out.
mkdir -p scene/sparse kept
cp "$model"/* scene/sparse/
for mask in "$masks"/*.png; do cp "$mask" "kept/$(basename "$mask" .png).mask.png"; done
InterfaceCOLMAP -i scene -o scene.mvs --image-folder "$photos/images" -w "$PWD"
echo '{"progress": 0.1}'
DensifyPointCloud scene.mvs -o dense.mvs --resolution-level "$resolution" --mask-path kept --ignore-mask-label 0 --remove-dmaps 1 -w "$PWD"
echo '{"progress": 0.5}'
ReconstructMesh dense.mvs -o rough.ply --close-holes 100 -w "$PWD"
echo '{"progress": 0.7}'
RefineMesh dense.mvs -m rough.ply -o refined.mvs --resolution-level "$resolution" -w "$PWD"
cp refined.ply "$mesh"
echo '{"progress": 1.0}'
