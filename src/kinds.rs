//! The product's kinds: how each is written as files, and the numbers that it has.

use engine::Kind;
use io::{document_extension, files};
use shape::{
    Aligned, BodyFeatures, Cameras, Document, Evidence, GirthId, Girths, Keypoints, Labels,
    Landmarks, LostParts, Masks, Mesh, People, Photos, Scene, Side, Sigmas, Tags, Textured, Tracks,
    Unit, Warps,
};
use stage::{Artifact, Metric};

/// Every kind that is written as files or has numbers: girths by tape (`girths.WC`) and along the contour
/// (`girths.WC.contour`), a surface's volume, area and size.
pub const KINDS: &[Kind] = &[
    Kind {
        facts: |artifact| artifact.downcast().map_or(vec![], |g| girths(&g)),
        names: girth_names,
        ..written(
            Girths::KIND,
            &["json", "csv", "fhir", "schema", "definitions"],
        )
    },
    Kind {
        facts: |artifact| artifact.downcast().map_or(vec![], |m| mesh(&m)),
        names: mesh_names,
        ..written(Mesh::KIND, &["ply", "glb", "obj", "stl", "3mf", "views"])
    },
    Kind {
        facts: |artifact| {
            let textured = artifact.downcast::<Textured>();
            textured.map_or(vec![], |t| mesh(&t.mesh))
        },
        names: mesh_names,
        ..written(
            Textured::KIND,
            &["glb", "ply", "obj", "stl", "3mf", "views"],
        )
    },
    written(
        Cameras::KIND,
        &["json", "colmap", "colmap-binary", "middlebury", "svg"],
    ),
    on_photos(Masks::KIND, &["png", "sheet"]),
    on_photos(Aligned::KIND, &["jpg"]),
    written(Scene::KIND, &["png"]),
    on_photos(Evidence::KIND, &["png"]),
    on_photos(Labels::KIND, &["png"]),
    written(Photos::KIND, &["capture"]),
    written(BodyFeatures::KIND, &["json"]),
    written(Landmarks::KIND, &["json"]),
    Kind {
        extension: document_extension,
        ..written(Document::KIND, &["file"])
    },
    written(Tags::KIND, &["json"]),
    written(Warps::KIND, &["json"]),
    on_photos(Keypoints::KIND, &["png"]),
    on_photos(People::KIND, &["png", "json"]),
    on_photos(LostParts::KIND, &["json"]),
    on_photos(Tracks::KIND, &["png", "json"]),
];

/// A kind that is written in these formats and has no numbers.
const fn written(name: &'static str, formats: &'static [&'static str]) -> Kind {
    Kind {
        name,
        formats,
        beside: None,
        files,
        extension: |_| None,
        facts: |_| vec![],
        names: |_| vec![],
    }
}

/// A kind whose files are called after photos, or drawn on them.
const fn on_photos(name: &'static str, formats: &'static [&'static str]) -> Kind {
    Kind {
        beside: Some(Photos::KIND),
        ..written(name, formats)
    }
}

fn mesh_names(_: &[String]) -> Vec<String> {
    ["volume", "area", "faces", "vertices"]
        .map(String::from)
        .to_vec()
}

/// What a girth has beside its tape: along the contour, its interval and how wide that is, what repeats it, and whether it
/// was refused (1) or given (0).
const OF_GIRTH: [&str; 6] = [
    "contour",
    "width",
    "interval.lo",
    "interval.hi",
    "repeat",
    "refused",
];

/// Girths of the table, and those of the user's own among what the pipeline declares.
fn girth_names(declared: &[String]) -> Vec<String> {
    let own = declared.iter().flat_map(|name| {
        let sides = Side::BOTH.map(|side| format!("{name}{}", side.suffix()));
        std::iter::once(name.clone()).chain(sides)
    });
    let girths = GirthId::all().map(GirthId::name).chain(own);
    let all = girths.flat_map(|n| {
        let own = OF_GIRTH.iter().map(|end| format!("{n}.{end}"));
        let sigmas = Sigmas::default().named();
        let sigmas = sigmas.map(|(part, _)| format!("{n}.sigma.{part}"));
        std::iter::once(n.clone())
            .chain(own)
            .chain(sigmas)
            .collect::<Vec<_>>()
    });
    let beside = ["stature", "volume"].into_iter().chain(Girths::RATIOS);
    all.chain(beside.map(String::from)).collect()
}

fn metric(name: &str, value: f64, unit: &str) -> Metric {
    Metric {
        name: name.into(),
        value,
        unit: unit.into(),
    }
}

fn girths(girths: &Girths) -> Vec<Metric> {
    // Without a scale, 1 is the radius of the camera ring.
    let length = |name: &str, mm: f64| match girths.unit {
        Unit::Metric => metric(name, mm / 10.0, "cm"),
        Unit::Relative => metric(name, mm / 1000.0, "relative"),
    };
    let mut all = Vec::new();
    for g in &girths.girths {
        // The girth is that of a tape, wherever somebody asks for it; headings name it.
        let mut tape = length(&g.name, g.tape_mm);
        tape.unit += " tape";
        all.push(tape);
        all.push(length(&format!("{}.contour", g.name), g.contour_mm));
        if let Some([lo, hi]) = g.interval_mm {
            all.push(length(&format!("{}.width", g.name), hi - lo));
            all.push(length(&format!("{}.interval.lo", g.name), lo));
            all.push(length(&format!("{}.interval.hi", g.name), hi));
        }
        for (part, mm) in g.sigmas.named() {
            all.extend(mm.map(|mm| length(&format!("{}.sigma.{part}", g.name), mm)));
        }
        all.extend(
            g.repeat_mm
                .map(|mm| length(&format!("{}.repeat", g.name), mm)),
        );
        all.push(metric(&format!("{}.refused", g.name), 0.0, ""));
    }
    let refused = girths.missing.iter().map(|m| format!("{}.refused", m.name));
    all.extend(refused.map(|name| metric(&name, 1.0, "")));
    all.extend(girths.stature_mm.map(|mm| length("stature", mm)));
    all.extend(girths.volume_l.map(|l| metric("volume", l, "l")));
    all.extend(
        girths
            .ratios
            .iter()
            .map(|(name, value, _)| metric(name, *value, "")),
    );
    all
}

fn mesh(mesh: &Mesh) -> Vec<Metric> {
    let area: f64 = (0..mesh.faces.len())
        .map(|f| mesh.area_vector(f).norm() / 2.0)
        .sum();
    let (volume, unit) = mesh.unit.volume(mesh.volume());
    vec![
        metric("volume", volume, unit),
        match mesh.unit {
            Unit::Metric => metric("area", area * 1e-6, "m²"),
            unit => metric("area", area * 1e-6, unit.length(1.0).1),
        },
        metric("faces", mesh.faces.len() as f64, ""),
        metric("vertices", mesh.positions.len() as f64, ""),
    ]
}
