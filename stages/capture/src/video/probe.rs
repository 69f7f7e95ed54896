//! What `ffprobe` reads of a video: size, rotation, brightness, length. Places, names and sound are not asked for.

use serde_json::Value;

/// What is known of a video's pictures.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Clip {
    /// The stream that holds them.
    pub(crate) stream: u64,
    /// Width and height as they are in the file. \[px\]
    pub(crate) size: [u64; 2],
    /// Brighter than a screen shows (PQ or HLG).
    pub(crate) hdr: bool,
    /// Whether the file names how colours were coded.
    pub(crate) coded: bool,
    /// Width of a pixel against its height.
    pub(crate) aspect: f64,
    /// Two half pictures in each.
    pub(crate) interlaced: bool,
    /// How long it is, where the file records that. \[s\]
    pub(crate) seconds: Option<f64>,
    /// How many pictures there should be, where the file records that.
    pub(crate) frames: Option<u64>,
}

/// What `ffprobe` is asked.
pub(crate) const ASK: [&str; 6] = [
    "-v",
    "error",
    "-of",
    "json",
    "-show_entries",
    "format=duration:stream=index,codec_type,width,height,sample_aspect_ratio,field_order,\
     color_space,color_transfer,nb_frames,duration:stream_disposition=attached_pic",
];

/// Reads its answer; nothing where there are no moving pictures.
pub(crate) fn clip(answer: &[u8]) -> Option<Clip> {
    let answer: Value = serde_json::from_slice(answer).ok()?;
    let moving = |s: &&Value| {
        s["codec_type"] == "video" && s["disposition"]["attached_pic"] != 1 && s["width"].is_u64()
    };
    let stream = answer["streams"].as_array()?.iter().find(moving)?;
    let text = |key: &str| stream[key].as_str().unwrap_or_default();
    let number = |v: &Value| v.as_str()?.parse::<f64>().ok().filter(|x| *x > 0.0);
    let aspect = || {
        let (a, b) = text("sample_aspect_ratio").split_once(':')?;
        let (a, b): (f64, f64) = (a.parse().ok()?, b.parse().ok()?);
        (a > 0.0 && b > 0.0).then(|| a / b)
    };
    Some(Clip {
        stream: stream["index"].as_u64()?,
        size: [stream["width"].as_u64()?, stream["height"].as_u64()?],
        hdr: ["smpte2084", "arib-std-b67"].contains(&text("color_transfer")),
        coded: !matches!(text("color_space"), "" | "unknown" | "reserved"),
        aspect: aspect().unwrap_or(1.0),
        interlaced: ["tt", "bb", "tb", "bt"].contains(&text("field_order")),
        seconds: number(&stream["duration"]).or(number(&answer["format"]["duration"])),
        frames: number(&stream["nb_frames"]).map(|n| n as u64),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_phones_video_is_understood_and_a_cover_is_no_video() {
        let answer = r#"{"streams": [
            {"index": 0, "codec_type": "video", "width": 300, "height": 300, "disposition": {"attached_pic": 1}},
            {"index": 1, "codec_type": "audio"},
            {"index": 2, "codec_type": "video", "width": 1920, "height": 1080, "sample_aspect_ratio": "4:3",
             "color_space": "bt2020nc", "color_transfer": "arib-std-b67", "nb_frames": "301",
             "disposition": {"attached_pic": 0}}],
            "format": {"duration": "10.03"}}"#;
        let clip = clip(answer.as_bytes()).unwrap();
        assert_eq!((clip.stream, clip.size), (2, [1920, 1080]));
        assert!(clip.hdr && clip.coded && !clip.interlaced);
        proof::near(clip.aspect, 4.0 / 3.0, 1e-12);
        assert_eq!((clip.seconds, clip.frames), (Some(10.03), Some(301)));
    }

    #[test]
    fn what_has_no_moving_pictures_is_none() {
        for answer in [
            "",
            "{}",
            r#"{"streams": []}"#,
            r#"{"streams": [{"index": 0, "codec_type": "audio"}]}"#,
            r#"{"streams": [{"index": 0, "codec_type": "video"}]}"#,
        ] {
            assert_eq!(clip(answer.as_bytes()), None, "{answer}");
        }
    }
}
