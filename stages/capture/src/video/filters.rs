//! What `ffmpeg` is to do to frames, as a chain of its filters.

use crate::video::probe::Clip;

/// Which frames are wanted, and how.
pub(crate) struct Wanted<'a> {
    /// Their numbers, in order; all if none are given.
    pub(crate) which: Option<&'a [usize]>,
    /// No longer than this on the longer side. \[px\]
    pub(crate) longest: u32,
    /// Brightness alone.
    pub(crate) grey: bool,
}

impl Wanted<'_> {
    /// The filters, one behind the other.
    pub(crate) fn filters(&self, clip: &Clip) -> String {
        let mut chain = Vec::new();
        // Before anything is left out, so that frames keep their numbers.
        if clip.interlaced {
            chain.push("bwdif=mode=send_frame".to_owned());
        }
        match self.which {
            None => chain.push("showinfo=checksum=0".to_owned()),
            Some(which) => {
                let each: Vec<String> = which.iter().map(|n| format!("eq(n\\,{n})")).collect();
                chain.push(format!("select='{}'", each.join("+")));
            }
        }
        let longest = self.longest;
        if (clip.aspect - 1.0).abs() > 1e-3 {
            chain.push("scale=w='trunc(iw*sar/2)*2':h=ih,setsar=1".to_owned());
        }
        let assumed = match clip.coded || clip.hdr || clip.size.iter().all(|s| *s < 1280) {
            true => "",
            // Large pictures that do not name their coding are coded as those of television are.
            false => ":in_color_matrix=bt709",
        };
        let exact = "accurate_rnd+full_chroma_int+full_chroma_inp+bitexact";
        let scaled = |flags: &str, assumed: &str| {
            format!(
                "scale=w='min({longest},iw)':h='min({longest},ih)':force_original_aspect_ratio=decrease:\
                 flags={flags}+{exact}{assumed},setsar=1"
            )
        };
        let flags = if self.grey { "area" } else { "bicubic" };
        let format = if self.grey { "gray" } else { "rgb24" };
        if clip.hdr {
            // To light (white at 203 cd/m², ITU-R BT.2408), to the colours of screens; what is brighter
            // than half of white is bent down, five times white to white; to a screen's levels.
            chain.push("setparams=colorspace=bt2020nc:color_primaries=bt2020".into());
            chain.push("zscale=t=linear:npl=203,format=gbrpf32le,zscale=p=709".into());
            chain.push("tonemap=mobius:param=0.5:peak=5:desat=0".into());
            chain.push("zscale=t=iec61966-2-1:m=gbr:r=full,format=gbrp".into());
            chain.push(format!("format={format}"));
        } else {
            chain.push(format!("{},format={format}", scaled(flags, assumed)));
        }
        // Times of their own, so that none is taken for another.
        chain.push("settb=1/1000000,setpts=N*1000".to_owned());
        chain.join(",")
    }
}
