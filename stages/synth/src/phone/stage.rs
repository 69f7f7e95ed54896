//! The stage that takes photos again through a phone's camera.

use crate::phone::draw::{Fault, draw};
use crate::phone::finish::{denoised, grained, levels, sharpened};
use crate::phone::lens::{Linear, blurred, light, resampled, shaken};
use crate::phone::params::PhoneParams;
use crate::phone::tone::toned;
use rayon::prelude::*;
use shape::{Photo, Photos, Rgb, rgb_to_jpeg, rgb_to_png};
use stage::{Ctx, Stage, Stop};
use std::path::Path;
use std::sync::Arc;

stage::inputs! {
    /// Photos of a good camera.
    pub struct PhoneInput {
        /// The photos.
        photos: Arc<Photos>,
    }
}

/// `synth.phone`: photos → photos.
pub struct Phone;

impl Stage for Phone {
    const NAME: &'static str = "synth.phone";
    const VERSION: u32 = 2;
    const ABOUT: &'static str = "Takes photos again with the faults of a phone's camera, each of which is off unless asked for.";
    type Params = PhoneParams;
    type Input = PhoneInput;
    type Output = Photos;
    const METRICS: &'static [&'static str] = &["photos changed"];

    fn run(p: &PhoneParams, input: PhoneInput, ctx: &Ctx<'_>) -> Result<Photos, Stop> {
        let all = &input.photos;
        let (faults, of_plate) = draw(p, all.photos.len());
        let steps = ctx.steps("photos", all.photos.len());
        let one = |(i, (photo, fault)): (usize, (&Photo, &Fault))| -> Result<Photo, Stop> {
            let taken = taken(p, photo, fault, i as u32)?;
            steps.tick()?;
            Ok(taken)
        };
        let pairs: Vec<_> = all.photos.iter().zip(&faults).enumerate().collect();
        let photos: Vec<Photo> = pairs
            .into_par_iter()
            .map(one)
            .collect::<Result<_, Stop>>()?;
        let plate = all.plate.as_ref().filter(|_| p.plate);
        let plate = plate.map(|plate| taken(p, plate, &of_plate, u32::MAX));
        let changed = photos
            .iter()
            .zip(&all.photos)
            .filter(|(a, b)| a.file != b.file);
        ctx.metric("photos changed", changed.count() as f64, "");
        let mut rig = all.rig.clone();
        if !p.mat {
            (rig.mat, rig.rim) = (None, None);
        }
        Ok(Photos {
            photos,
            plate: plate.transpose()?,
            rig,
        })
    }
}

/// One photo with its faults; as it was where it has none.
fn taken(p: &PhoneParams, photo: &Photo, fault: &Fault, number: u32) -> Result<Photo, Stop> {
    let finish = [p.noise_levels, p.denoise_levels, p.sharpen];
    let lens = [p.vignetting, p.lateral_px];
    let none = *fault == Fault::NONE && finish.iter().chain(&lens).all(|v| *v == 0.0);
    if none && p.jpeg_quality == 0 {
        return Ok(photo.clone());
    }
    let mut pixels = photo.decode()?;
    if !none {
        pixels = through(p, &pixels, fault, number);
    }
    let (ending, file) = match p.jpeg_quality {
        0 => ("png", rgb_to_png(&pixels)),
        quality => ("jpg", rgb_to_jpeg(&pixels, quality as u8)),
    };
    let name = Path::new(&photo.name).with_extension(ending);
    Ok(Photo {
        name: name.to_string_lossy().into_owned(),
        orientation: 1,
        file: file.into(),
        ..photo.clone()
    })
}

/// The way of light through the lens to the sensor, and what the phone makes of it.
fn through(p: &PhoneParams, pixels: &Rgb, fault: &Fault, number: u32) -> Rgb {
    let mut image: Linear = light(pixels);
    if fault.shift != [0.0; 2] || p.lateral_px > 0.0 {
        image = resampled(&image, fault.shift, p.lateral_px as f32);
    }
    if fault.shake != [0.0; 2] {
        image = shaken(&image, fault.shake);
    }
    if fault.blur > 0.0 {
        image = blurred(&image, fault.blur);
    }
    let mut image = levels(&image, fault.gains, p.vignetting as f32);
    if fault.tone > 0.0 {
        let reach = p.local_reach as f32 * image.width.max(image.height) as f32;
        image = toned(&image, fault.tone, reach);
    }
    if p.noise_levels > 0.0 {
        grained(&mut image, p.noise_levels as f32, p.seed, number);
    }
    if p.denoise_levels > 0.0 {
        image = denoised(&image, p.denoise_levels as f32);
    }
    if p.sharpen > 0.0 {
        image = sharpened(&image, p.sharpen as f32);
    }
    image.map(|v| v.map(|v| v.round().clamp(0.0, 255.0) as u8))
}
