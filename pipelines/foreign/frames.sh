#!/bin/sh
# Frames of a video at even times: frames.sh FOLDER OUT COUNT
# FOLDER holds one video and maybe capture.toml, which goes along; OUT/images gets COUNT frames as JPEG.
set -eu
folder=$1 out=$2 count=$3
video=
for file in "$folder"/*; do
  case $file in
    *.toml) cp "$file" "$out/" ;;
    *) test -z "$video" || { echo "more than one video: $video and $file" >&2; exit 1; }; video=$file ;;
  esac
done
test -n "$video" || { echo "no video in the folder" >&2; exit 1; }
# Counted by decoding: what the file says of itself may be wrong.
total=$(ffprobe -v error -select_streams v:0 -count_frames -show_entries stream=nb_read_frames -of csv=p=0 "$video")
test "$total" -ge "$count" || { echo "the video has $total frames, fewer than $count" >&2; exit 1; }
mkdir -p "$out/images"
# Frame n is taken where the count of those due rises.
ffmpeg -v error -threads 1 -i "$video" -vf "select='gt(floor((n+1)*$count/$total),floor(n*$count/$total))'" \
  -fps_mode passthrough -q:v 1 -start_number 0 "$out/images/%04d.jpg"
