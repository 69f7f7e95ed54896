//! Marker tags in `capture.toml`: the mat on the disk, the strip on its rim.

use crate::keys::{Keys, RigError};
use shape::{Mat, Rig, Rim};
use stage::{Message, message};
use toml::Value;

stage::messages! {
    WIDE_MAT = "warn-wide-mat": "capture.toml: the tags of `[mat]` reach {reach:.0 mm} from the disk's middle, but the disk ends at {disk:.0 mm}: measure a printed tag, the ring and the disk, and correct what is wrong";
    WIDE_RIM = "warn-wide-rim": "capture.toml: the strip of `[rim]` has a radius of {rim:.0 mm}, the disk one of {disk:.0 mm}: measure the disk, and correct what is wrong";
    FAMILY = "rig-family": "tag36h11, the only family that is known";
    IDS = "rig-ids": "[first, last], the last at most 586";
    IDS_OF = "rig-ids-of": "[first, last] of {count} ids";
    RIM_ALONE = "rig-rim-alone": "`rim` has tags on the disk's rim, but there is no `mat`: these tags serve beside a mat on the disk only";
    AMONG = "rig-among": "tags {first} to {last} of `rim` are among those of `mat`: give `ids` of their own";
    NO_RADIUS = "rig-no-radius": "`rim` has no `radius_mm`, nor has `disk` a diameter";
}

/// A number that must be there.
fn need(keys: &mut Keys<'_>, key: &'static str) -> Result<f64, RigError> {
    keys.known(key)?.ok_or_else(|| keys.lacks(key))
}

/// Family, first id and how many.
fn read_ids(keys: &mut Keys<'_>) -> Result<(u32, u32), RigError> {
    if let Some(family) = keys.text("family")?.filter(|family| family != "tag36h11") {
        return Err(keys.wrong("family", message!(FAMILY), &family.into()));
    }
    let given = keys.number("count", 1.0, 587.0)?.map(|count| count as u32);
    let Some(ids) = keys.take("ids") else {
        return Ok((0, given.ok_or_else(|| keys.lacks("count"))?));
    };
    let list: Vec<i64> = ids
        .as_array()
        .into_iter()
        .flatten()
        .filter_map(Value::as_integer)
        .collect();
    match list.as_slice() {
        [first, last] if (0..=*last).contains(first) && *last <= 586 => {
            let count = (last - first + 1) as u32;
            match given.filter(|given| *given != count) {
                Some(given) => Err(keys.wrong("ids", message!(IDS_OF, count = given), &ids)),
                None => Ok((*first as u32, count)),
            }
        }
        _ => Err(keys.wrong("ids", message!(IDS), &ids)),
    }
}

/// `[mat]`: a mat; or, where only the size of its tags is given, that size. \[mm\]
pub(crate) fn read_mat(keys: &mut Keys<'_>) -> Result<(Option<Mat>, Option<f64>), RigError> {
    const LAYOUT: [&str; 3] = ["count", "ids", "ring_radius_mm"];
    if !LAYOUT.iter().any(|key| keys.has(key)) {
        keys.text("family")?;
        LAYOUT.iter().for_each(|key| drop(keys.take(key)));
        return Ok((None, Some(need(keys, "tag_size_mm")?)));
    }
    let (first_id, count) = read_ids(keys)?;
    let mat = Mat {
        tag_mm: need(keys, "tag_size_mm")?,
        first_id,
        count,
        ring_mm: need(keys, "ring_radius_mm")?,
    };
    Ok((Some(mat), None))
}

/// `[rim]`: its tags have numbers of their own, and belong to a disk with a mat.
pub(crate) fn read_rim(keys: &mut Keys<'_>, rig: &Rig) -> Result<Rim, RigError> {
    let Some(mat) = rig.mat.as_ref() else {
        return Err(RigError::missing(message!(RIM_ALONE)));
    };
    let (first_id, count) = read_ids(keys)?;
    if first_id < mat.first_id + mat.count && mat.first_id < first_id + count {
        let last = first_id + count - 1;
        return Err(RigError::wrong(message!(
            AMONG,
            first = first_id,
            last = last
        )));
    }
    let radius = keys.known("radius_mm")?;
    let radius_mm = radius
        .or(rig.disk_diameter_mm.map(|d| d / 2.0))
        .ok_or_else(|| RigError::missing(message!(NO_RADIUS)))?;
    Ok(Rim {
        tag_mm: need(keys, "tag_size_mm")?,
        first_id,
        count,
        radius_mm,
    })
}

/// What cannot be true at once of disk, mat and rim.
pub(crate) fn doubts(rig: &Rig) -> Vec<Message> {
    let mut doubts = Vec::new();
    let Some(radius) = rig.disk_diameter_mm.map(|d| d / 2.0) else {
        return doubts;
    };
    if let Some(mat) = &rig.mat {
        let reach = libm::hypot(mat.ring_mm + mat.tag_mm / 2.0, mat.tag_mm / 2.0);
        if reach > 1.005 * radius {
            doubts.push(message!(WIDE_MAT, reach = reach, disk = radius));
        }
    }
    if let Some(rim) = &rig.rim
        && (rim.radius_mm / radius - 1.0).abs() > 0.02
    {
        doubts.push(message!(WIDE_RIM, rim = rim.radius_mm, disk = radius));
    }
    doubts
}

#[cfg(test)]
mod tests {
    use super::doubts;
    use crate::facts::Facts;
    use crate::keys::RigError;
    use crate::rig::{RigFile, read_rig};
    use shape::Rim;

    fn read(text: &str) -> Result<RigFile, RigError> {
        read_rig(text, &Facts::default())
    }

    const MAT: &str = "[disk]\ndiameter_cm = 45\n[mat]\ntag_size_mm = 60.0\nids = [0, 11]\n\
                       count = 12\nring_radius_mm = 187.0\n";

    #[test]
    fn a_strip_on_the_rim_is_read_beside_a_mat() {
        let text = format!("{MAT}[rim]\ntag_size_mm = 24.0\nids = [12, 47]\ncount = 36\n");
        let rim = Rim {
            tag_mm: 24.0,
            first_id: 12,
            count: 36,
            radius_mm: 225.0,
        };
        assert_eq!(read(&text).unwrap().rig.rim, Some(rim));
    }

    #[test]
    fn a_strip_that_cannot_serve_is_refused() {
        let rim = "[rim]\ntag_size_mm = 24.0\ncount = 36\n";
        for (text, part) in [
            (rim.to_owned(), "there is no `mat`"),
            (format!("{MAT}{rim}"), "tags 0 to 35 of `rim` are among"),
            (
                format!("{MAT}{rim}ids = [12, 40]"),
                "`rim.ids` wants [first, last] of 36 ids",
            ),
        ] {
            let error = read(&text).unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
    }

    #[test]
    fn of_a_mat_the_size_of_its_tags_may_be_all_that_is_known() {
        let rig = read("[mat]\ntag_size_mm = 59.7").unwrap().rig;
        assert_eq!((rig.mat, rig.tag_mm), (None, Some(59.7)));
        // Ids give how many there are.
        let whole = read(&MAT.replace("count = 12\n", "")).unwrap().rig;
        assert_eq!(whole.mat.unwrap().count, 12);
        let error = read("[mat]\ntag_size_mm = 59.7\ncount = 12").unwrap_err();
        assert!(error.missing && error.to_string().contains("no `ring_radius_mm`"));
    }

    #[test]
    fn a_mat_wider_than_its_disk_is_reported() {
        let doubts_of = |text: &str| doubts(&read(text).unwrap().rig);
        assert!(doubts_of(MAT).is_empty());
        let wide = doubts_of(&MAT.replace("187.0", "205.7"));
        assert!(wide[0].contains("reach 238 mm"), "{wide:?}");
        let strip =
            format!("{MAT}[rim]\ntag_size_mm = 24.0\nids = [12, 47]\ncount = 36\nradius_mm = 240");
        assert!(doubts_of(&strip)[0].contains("radius of 240 mm"));
    }

    #[test]
    fn what_photos_are_written_with_is_read_as_it_was() {
        let strip = "[rim]\ntag_size_mm = 24.5\nids = [12, 47]\ncount = 36\nradius_mm = 224.25\n\
                     [camera]\ncentre_px = [804.8, 1191.0]";
        let rig = read(&format!("{MAT}{strip}")).unwrap().rig;
        let photos = shape::Photos {
            rig: rig.clone(),
            ..shape::Photos::default()
        };
        let files = io::photos_to_capture(&photos);
        let (_, bytes) = files.iter().find(|f| f.0 == "capture.toml").unwrap();
        let back = read(std::str::from_utf8(bytes).unwrap()).unwrap();
        assert_eq!(back.rig, rig);
        assert!(back.unknown.is_empty());
    }
}
