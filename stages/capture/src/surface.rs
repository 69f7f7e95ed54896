//! The stage that takes a surface from elsewhere: a scan, or any mesh as PLY, OBJ, STL, OFF, GLB or 3MF.

pub use crate::scan::Unit;
use crate::scan::{
    MOST_FACES, Read, agreed, announced, closed, crown_opened, pieces, read, turned, unit, up,
};
use shape::Mesh;
use stage::{Ctx, Files, FilesError, Stage, Stop, message};
use std::sync::Arc;

stage::messages! {
    HOLES = "warn-scan-holes": "{name}: holes closed by flat covers: {count}, up to {across:.0 mm} across; tapes over a large one come out short";
    FAULT = "warn-surface-fault": "{name}: {fault}; sections across it may be missing";
    PIECES = "warn-scan-pieces": "{name}: pieces that do not hang together with the body are left out: {count}";
    MIXED = "warn-scan-mixed": "{name}: faces that disagreed with those around them about which side is outside were turned: {count}";
    INWARD = "warn-scan-inward": "{name}: its faces look inward; they were turned";
    TAKEN_AS = "warn-scan": "{name} is taken as {unit} with {axis} up, {height:.0 cm} tall: if that is wrong, give --unit-of-file and --up";
}

/// Units that are recognised, their millimetres and what they are called (structural).
const UNITS: [(Unit, f64, &str); 4] = [
    (Unit::Mm, 1.0, "mm"),
    (Unit::Cm, 10.0, "cm"),
    (Unit::M, 1000.0, "m"),
    (Unit::Inch, 25.4, "in"),
];

stage::choice! {
    /// The axis that points up.
    pub enum Up {
        /// x.
        X = "x",
        /// y.
        Y = "y",
        /// z.
        Z = "z",
        /// That which a body's head points to, or away from.
        Auto = "auto",
    }
}

stage::params! {
    /// How to read a surface.
    pub struct SurfaceParams {
        /// Unit of the file's numbers. A file that calls its lengths relative keeps them so, unless a unit
        /// other than mm is given.
        unit: Unit = Unit::Mm,
        /// The axis that points up.
        up: Up = Up::Z,
        /// Look at it as at a scan: of several pieces the body is taken, and faces that look inward are turned round.
        scan: bool = false,
    }
}

stage::inputs! {
    /// A surface from elsewhere.
    pub struct SurfaceInput {
        /// One file: PLY, OBJ, STL, OFF, GLB or 3MF.
        files: Arc<Files>,
    }
}

stage::failures! {
    /// Why there is no surface.
    pub enum SurfaceError {
        /// None or several.
        Count(count: usize) = "fail-scan-count": "one file with a surface is wanted, but {count} are there",
        /// Not a mesh.
        Read(name: String, why: String) = "fail-scan-read": "{name} cannot be read as a mesh: {why}",
        /// More faces than can be worked on.
        Faces(name: String, faces: usize) = "fail-scan-faces": "{name} has {faces} faces, more than 4 million: reduce them, such as to 400 000, and measure again",
        /// Two bodies, or a body in halves.
        Pieces(name: String) = "fail-scan-two": "{name} holds two large pieces that do not hang together: two bodies, or halves of one? Leave one person in the file, in one piece",
        /// A mesh that sections cannot be taken of.
        Fault(name: String, fault: String) = "fail-scan-fault": "{name}: {fault}",
        /// Nothing in it.
        Empty(name: String) = "fail-scan-empty": "{name} has no faces: a mesh is wanted, not a cloud of points",
        /// A size that no body has.
        Size {
            /// The file.
            name: String,
            /// Its height. \[mm\]
            high_mm: f64,
            /// The unit it was read in.
            unit: &'static str,
        } = "cli-scan-size": "{name} is {high_mm:.0 mm} high when its numbers are read as {unit}: set `unit`, or `up` if another axis points up",
    }
    wraps {
        /// A file that cannot be read.
        Files(FilesError),
    }
}

/// Heights of bodies, from less than a newborn to more than the tallest man on record, Robert Wadlow with 2 720 (1940).
/// \[mm\]
const HEIGHTS_MM: std::ops::RangeInclusive<f64> = 200.0..=3000.0;

/// `capture.surface`: files → mesh.
pub struct Surface;

impl Stage for Surface {
    const NAME: &'static str = "capture.surface";
    const VERSION: u32 = 5;
    const ABOUT: &'static str =
        "Takes a closed surface from elsewhere, such as a scan: PLY, OBJ, STL, OFF, GLB or 3MF.";
    type Params = SurfaceParams;
    type Input = SurfaceInput;
    type Output = Mesh;

    fn run(p: &SurfaceParams, input: SurfaceInput, ctx: &Ctx<'_>) -> Result<Mesh, Stop> {
        let entries = &input.files.entries;
        let [entry] = entries.as_slice() else {
            return Err(SurfaceError::Count(entries.len()).into());
        };
        let bytes = input.files.read(entry).map_err(SurfaceError::from)?;
        let many = announced(&entry.name, &bytes);
        if many > MOST_FACES {
            return Err(SurfaceError::Faces(entry.name.clone(), many).into());
        }
        let read =
            read(&entry.name, &bytes).map_err(|why| SurfaceError::Read(entry.name.clone(), why))?;
        Ok(upright(read, p, &entry.name, ctx)?)
    }
}

/// Brings a mesh to millimetres with z up, and checks it.
fn upright(read: Read, p: &SurfaceParams, name: &str, ctx: &Ctx<'_>) -> Result<Mesh, SurfaceError> {
    let Read { mut mesh, unit } = read;
    if mesh.faces.is_empty() {
        return Err(SurfaceError::Empty(name.into()));
    }
    if mesh.faces.len() > MOST_FACES {
        return Err(SurfaceError::Faces(name.into(), mesh.faces.len()));
    }
    if p.scan {
        mesh = body(mesh, name, ctx)?;
    }
    let mut covers = if p.scan { closed(&mut mesh) } else { vec![] };
    let (unit, mm) = oriented(&mut mesh, p, (name, unit), ctx);
    crown_opened(&mut mesh, &mut covers);
    let largest = covers.iter().map(|cover| cover.across * mm);
    if let Some(across) = largest.reduce(f64::max) {
        let count = covers.len();
        ctx.warn(message!(HOLES, name = name, count = count, across = across));
    }
    match mesh.validate_closed() {
        Ok(()) => {}
        // Holes and seams are borne: sections that do not close are refused where they matter.
        Err(fault @ (shape::MeshFault::Open(..) | shape::MeshFault::Pinched(_))) => {
            ctx.warn(message!(FAULT, name = name, fault = fault.to_string()));
        }
        Err(fault) => return Err(SurfaceError::Fault(name.into(), fault.to_string())),
    }
    let high_mm = tall(&mesh);
    if mesh.unit == shape::Unit::Metric && !HEIGHTS_MM.contains(&high_mm) {
        let name = name.into();
        return Err(SurfaceError::Size {
            name,
            high_mm,
            unit,
        });
    }
    Ok(mesh)
}

/// The piece that is the body, its faces looking outward.
fn body(mesh: Mesh, name: &str, ctx: &Ctx<'_>) -> Result<Mesh, SurfaceError> {
    let found = pieces(&mesh);
    if found.second {
        return Err(SurfaceError::Pieces(name.into()));
    }
    if found.left_out > 0 {
        ctx.warn(message!(PIECES, name = name, count = found.left_out));
    }
    let mut mesh = found.body;
    let mixed = agreed(&mut mesh);
    if mixed > 0 {
        ctx.warn(message!(MIXED, name = name, count = mixed));
    }
    if mesh.volume() < 0.0 {
        mesh.faces.iter_mut().for_each(|f| f.swap(1, 2));
        ctx.warn(message!(INWARD, name = name));
    }
    Ok(mesh)
}

/// Turns and scales a mesh as given or recognised; the unit of its numbers, and its millimetres.
fn oriented(
    mesh: &mut Mesh,
    p: &SurfaceParams,
    (name, named): (&str, Option<Unit>),
    ctx: &Ctx<'_>,
) -> (&'static str, f64) {
    let way = match p.up {
        Up::X => (0, false),
        Up::Y => (1, false),
        Up::Z => (2, false),
        Up::Auto => up(mesh).unwrap_or((2, false)),
    };
    turned(mesh, way);
    let known = UNITS.map(|(unit, mm, _)| (unit, mm));
    let own = match p.unit {
        // What calls its lengths relative has none.
        Unit::Auto if mesh.unit == shape::Unit::Relative => Unit::Mm,
        Unit::Auto => {
            // What the file names holds where a body can be so high.
            let high = |n: &Unit| known.iter().find(|k| k.0 == *n).map(|k| k.1 * tall(mesh));
            let fits = |n: &Unit| high(n).is_some_and(|mm| HEIGHTS_MM.contains(&mm));
            let seen = || unit(tall(mesh), &known).unwrap_or(Unit::Mm);
            named.filter(fits).unwrap_or_else(seen)
        }
        given => given,
    };
    if own != Unit::Mm {
        mesh.unit = shape::Unit::Metric;
    }
    let at = UNITS.iter().find(|u| u.0 == own);
    let (mm, word) = at.map_or((1.0, "mm"), |u| (u.1, u.2));
    for at in &mut mesh.positions {
        *at = at.map(|v| v * mm as f32);
    }
    if p.up == Up::Auto || p.unit == Unit::Auto {
        let axes = [["x", "y", "z"], ["-x", "-y", "-z"]];
        let axis = axes[usize::from(way.1)][way.0];
        let height = tall(mesh) / 10.0;
        ctx.warn(message!(
            TAKEN_AS,
            name = name,
            unit = word,
            axis = axis,
            height = height
        ));
    }
    (word, mm)
}

/// Height of an upright mesh.
fn tall(mesh: &Mesh) -> f64 {
    mesh.bounds().map_or(0.0, |(low, high)| high.z - low.z)
}
