//! What each kernel of the refinement costs: `cargo bench -p refine`, or `-- 400` for a mesh of about
//! 400 thousand faces. A textured ball before 18 cameras of 1600×2400; the least of three, on one
//! thread and on all.

use nalgebra::{Matrix3x4, Point3, Rotation3, Vector3};
use refine::evidence::contours::pulls;
use refine::evidence::patch::{Pairing, Window};
use refine::evidence::scene::{Scene, VisibilityRules};
use refine::evidence::visibility::Visibility;
use refine::geometry::curvature::{Laplacian, shape_operators};
use refine::geometry::remesh::{relax, remesh};
use refine::motion::normal_equations::point_shifts;
use refine::pictures::depth::DepthMap;
use refine::pictures::fixed::fixed;
use refine::pictures::halving::halved;
use refine::pictures::picture::Picture;
use refine::surface::energy::Forces;
use refine::surface::smooth::ring_median;
use refine::surface::step::{Rest, displacements};
use refine::surface::sweep::sweep;
use shape::{Adjacency, Gray, Mesh};
use std::time::Instant;

const RADIUS: f64 = 400.0;
const SIZE: [usize; 2] = [1600, 2400];

/// The ball from a ring of cameras, brightness a few waves through space.
fn picture(k: usize) -> Picture {
    let angle = k as f64 * std::f64::consts::TAU / 18.0;
    let centre = Point3::new(3000.0 * libm::cos(angle), 3000.0 * libm::sin(angle), 300.0);
    let forward = (Point3::origin() - centre).normalize();
    let right = forward.cross(&Vector3::z()).normalize();
    let axes = [right, forward.cross(&right), forward].map(|a| a.transpose());
    let rotation = Rotation3::from_matrix_unchecked(nalgebra::Matrix3::from_rows(&axes));
    let focal = 4500.0;
    let middle = SIZE.map(|n| (n as f64 - 1.0) / 2.0);
    let lens = nalgebra::Matrix3::new(focal, 0.0, middle[0], 0.0, focal, middle[1], 0.0, 0.0, 1.0);
    let mut pose = Matrix3x4::zeros();
    pose.fixed_view_mut::<3, 3>(0, 0)
        .copy_from(rotation.matrix());
    pose.set_column(3, &-(rotation * centre.coords));
    let (mut gray, mut inside) = (
        Gray::filled(SIZE[0], SIZE[1], 30.0),
        Gray::filled(SIZE[0], SIZE[1], -99.0),
    );
    for y in 0..SIZE[1] {
        for x in 0..SIZE[0] {
            let (u, v) = (
                (x as f64 - middle[0]) / focal,
                (y as f64 - middle[1]) / focal,
            );
            let ray = (axes[0].transpose() * u + axes[1].transpose() * v + forward).normalize();
            let b = centre.coords.dot(&ray);
            let nearest = (centre.coords.norm_squared() - b * b).sqrt();
            *inside.at_mut(x, y) = ((RADIUS - nearest) * focal / 3000.0) as f32;
            let root = b * b - centre.coords.norm_squared() + RADIUS * RADIUS;
            if root > 0.0 {
                let p = centre + ray * (-b - root.sqrt());
                let waves = libm::sin(0.9 * p.x + 0.4 * p.z)
                    + libm::sin(0.7 * p.y - 0.8 * p.z)
                    + libm::sin(1.3 * p.z + 0.3 * p.x);
                *gray.at_mut(x, y) = (128.0 + 25.0 * waves) as f32;
            }
        }
    }
    Picture {
        gray: fixed(&gray).into(),
        whole: SIZE,
        corner: [0; 2],
        projection: lens * pose,
        centre,
        focal,
        inside: Some(fixed(&inside).into()),
        border: None,
        noise: 1.0,
    }
}

/// A ball with edges of this length.
fn ball(edge_mm: f64) -> Mesh {
    let s = RADIUS as f32;
    let corner = |x, y, z| [x * s, y * s, z * s];
    let mut mesh = Mesh {
        positions: vec![
            corner(1.0, 0.0, 0.0),
            corner(-1.0, 0.0, 0.0),
            corner(0.0, 1.0, 0.0),
            corner(0.0, -1.0, 0.0),
            corner(0.0, 0.0, 1.0),
            corner(0.0, 0.0, -1.0),
        ],
        faces: vec![
            [0, 2, 4],
            [2, 1, 4],
            [1, 3, 4],
            [3, 0, 4],
            [2, 0, 5],
            [1, 2, 5],
            [3, 1, 5],
            [0, 3, 5],
        ],
        ..Mesh::default()
    };
    let round = |mesh: &mut Mesh| {
        for p in &mut mesh.positions {
            let long = p.iter().map(|x| x * x).sum::<f32>().sqrt();
            *p = p.map(|x| x / long * s);
        }
    };
    let mut edge = RADIUS / 2.0;
    while edge > edge_mm {
        mesh = remesh(&mesh, edge, 2);
        round(&mut mesh);
        edge = (edge / 1.6).max(edge_mm * 0.999);
    }
    mesh = remesh(&mesh, edge_mm, 2);
    round(&mut mesh);
    mesh
}

/// The least time of three. \[ms\]
fn least<T>(mut once: impl FnMut() -> T) -> f64 {
    let time = |_| {
        let start = Instant::now();
        std::hint::black_box(once());
        start.elapsed().as_secs_f64() * 1e3
    };
    (0..3).map(time).fold(f64::INFINITY, f64::min)
}

/// Times kernels on one thread and on all, a line each.
struct Timer {
    pools: [rayon::ThreadPool; 2],
    vertices: usize,
}

impl Timer {
    /// Prints the head of the table.
    fn new(mesh: &Mesh) -> Timer {
        let cores = std::thread::available_parallelism().map_or(1, usize::from);
        let vertices = mesh.positions.len();
        println!(
            "{} faces, {vertices} vertices, 18 photos of 1600×2400; milliseconds",
            mesh.faces.len()
        );
        println!(
            "{:34} {:>9} {:>9} {:>14}",
            "",
            "1 thread",
            format!("{cores} threads"),
            "ns a vertex, 1"
        );
        let pools = [1, cores].map(|n| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build();
            pool.expect("a pool of threads")
        });
        Timer { pools, vertices }
    }

    /// Prints what a kernel costs.
    fn line(&self, name: &str, run: &(dyn Fn() + Sync)) {
        let [one, all] = [0, 1].map(|k| least(|| self.pools[k].install(run)));
        println!(
            "{name:34} {one:9.1} {all:9.1} {:14.0}",
            one * 1e6 / self.vertices as f64
        );
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().collect();
    let thousands = arguments.iter().find_map(|a| a.parse::<f64>().ok());
    let faces = thousands.unwrap_or(200.0) * 1e3;
    // Area of an even triangle of edge e: √3/4 e².
    let area = 4.0 * std::f64::consts::PI * RADIUS * RADIUS;
    let mesh = ball((area / faces / 0.433).sqrt());
    let pictures: Vec<Picture> = (0..18).map(picture).collect();
    let count = mesh.positions.len();
    let timer = Timer::new(&mesh);
    let line = |name: &str, run: &(dyn Fn() + Sync)| timer.line(name, run);
    mesh_and_pictures(&timer, &mesh, &pictures[0]);
    let window = Window::new(4, true);
    let rules = VisibilityRules::new(65.0, Pairing::between(3.0, 50.0), 4.0);
    let around = Adjacency::new(&mesh);
    let scene = Scene::new(&mesh, &around, &pictures, &window, &rules);
    let normals = mesh.normals();
    let x: Vec<_> = (0..count as u32).map(|v| mesh.point(v).coords).collect();
    let laplacian = Laplacian::new(&mesh, &around);
    let rest = Rest::new(&laplacian, &x, &normals, 20);
    let visible = Visibility::new(&scene);
    let contours = pulls(&scene, 3.0);
    let footprint = 3000.0 / 4500.0;
    let bending = 0.04 * 8f64.powi(4) * footprint * footprint;
    let forces = Forces {
        pictures: &pictures,
        visible: &visible,
        rules: &rules,
        window: &window,
        pulls: &contours,
        outside: &[],
        hull_weight: 0.0,
        laplacian: &laplacian,
        footprint,
        contour_weight: 0.3,
        rest: &rest,
        bending,
        anchor: 1e-4,
    };
    let still = vec![0.0; count];
    let seen = forces.agreements::<1>(&still, |_| None);
    let data_term = forces.data_term(&seen);
    line("visibility and weights", &|| {
        drop(Visibility::new(&scene));
    });
    line("the same, and equations of motion", &|| {
        drop(point_shifts(&scene, footprint))
    });
    let slopes = || forces.agreements::<1>(&still, |_| None);
    let scores = || forces.agreements::<0>(&still, |_| None);
    line("consistency", &|| drop(scores()));
    line("consistency and its slope", &|| drop(slopes()));
    line("contours", &|| drop(pulls(&scene, 3.0)));
    line("Laplacian", &|| drop(Laplacian::new(&mesh, &around)));
    line("rest shape, 20 rings", &|| {
        drop(Rest::new(&laplacian, &x, &normals, 20));
    });
    line("displacements, 60 rounds of CG", &|| {
        drop(displacements(
            &data_term, &laplacian, &x, &normals, &rest, bending, 60,
        ));
    });
    line("weighted median", &|| {
        let mut data_term = data_term.clone();
        let weights = (1.0, 1.0);
        ring_median(
            &mesh,
            &around,
            &laplacian,
            &normals,
            &mut data_term,
            weights,
            footprint,
        );
    });
    line("search, 9 places", &|| {
        drop(sweep(&forces, &around, [5, 3], footprint, |_| true))
    });
}

/// Beside the energy: pictures, and the mesh alone.
fn mesh_and_pictures(timer: &Timer, mesh: &Mesh, picture: &Picture) {
    let line = |name: &str, run: &(dyn Fn() + Sync)| timer.line(name, run);
    let around = Adjacency::new(mesh);
    let normals = mesh.normals();
    let gray = picture.gray.map(|steps| f32::from(*steps));
    line("halving one photo", &|| drop(halved(&gray)));
    line("depth map of one photo", &|| {
        drop(DepthMap::new(mesh, picture, 2.0));
    });
    line("shape operators", &|| {
        drop(shape_operators(mesh, &around, &normals, 0.1));
    });
    line("relaxing", &|| relax(&mut mesh.clone(), &around));
    line("remeshing to other edges", &|| {
        drop(remesh(mesh, mesh.mean_edge() * 0.9, 1));
    });
}
