//! Params of the stage that takes the photos of a turn.

stage::params! {
    /// How body, disk, background and photos look, and what the user knows.
    pub struct TurnParams {
        /// Contrast of the body's texture: 0 none, 0.05 skin, 1 a printed dress.
        #[range(0.0..=1.0)]
        #[source(structural)]
        contrast: f64 = 0.5,
        /// Size of the finest marks on the body.
        #[range(0.5..=200.0)]
        #[source(structural)]
        finest_mm: f64 = 4.0,
        /// Size of the coarsest marks on the body.
        #[range(1.0..=500.0)]
        #[source(structural)]
        coarsest_mm: f64 = 64.0,
        /// Share of light that comes from all sides; the rest is a Lambert light beside the camera.
        #[range(0.0..=1.0)]
        #[source(structural)]
        ambient: f64 = 0.5,
        /// Radius of a lamp's or a window's face as seen from the body; 0: the light beside the camera, which throws no shadow. In a
        /// film nothing throws one.
        #[range(0.0..=45.0)]
        #[source(structural)]
        lamp_deg: f64 = 0.0,
        /// How far to the right of the camera the lamp is, seen from the body.
        #[range(-180.0..=180.0)]
        #[source(structural)]
        lamp_right_deg: f64 = -40.0,
        /// How far above the horizon the lamp is.
        #[range(0.0..=90.0)]
        #[source(structural)]
        lamp_up_deg: f64 = 40.0,
        /// Standard deviation of the sensor's noise, in levels of 0..=255.
        #[range(0.0..=50.0)]
        #[source(structural)]
        noise_levels: f64 = 1.0,
        /// Whether levels are in proportion to light; else they are sRGB, as cameras write them.
        linear: bool = false,
        /// Rays through each pixel along each of its sides.
        #[range(1..=8)]
        #[source(structural)]
        rays: u32 = 3,
        /// Quality of the JPEG files, 1 to 100; 0 writes PNG, without loss.
        #[range(0..=100)]
        #[source(structural)]
        jpeg_quality: u32 = 93,
        /// Whether a marker mat is on the disk; else it is wood.
        mat: bool = true,
        /// Whether a strip of tags goes around the rim of a disk with a mat.
        rim: bool = false,
        /// Whether there is a photo of the scene without the body.
        plate: bool = true,
        /// By how much the focal length that EXIF tells is too short, as a share of it.
        #[range(-0.2..=0.2)]
        #[source(structural)]
        exif_error: f64 = 0.004,
        /// Background, clothes, skin, light and disk are drawn by this number; 0: the default, skin all over, a disk of wood.
        /// A surface with colours of its own wears these.
        #[range(0..=1000000)]
        #[source(structural)]
        scene: u32 = 0,
        /// How far hands are elsewhere in each photo, one standard deviation a side; the head moves half as far, and a breath
        /// lifts the chest by a quarter.
        #[range(0.0..=200.0)]
        #[source(structural)]
        restless_mm: f64 = 0.0,
        /// How far feet are elsewhere in each photo, one standard deviation a side: legs follow from the hip down.
        #[range(0.0..=200.0)]
        #[source(structural)]
        feet_mm: f64 = 0.0,
        /// How far arms are raised about the shoulders; below 0 they hang closer to the body.
        #[range(-45.0..=90.0)]
        #[source(structural)]
        arms_deg: f64 = 0.0,
        /// How far shorts hang away from the legs at their hem, in folds that hang otherwise in each photo.
        #[range(0.0..=200.0)]
        #[source(structural)]
        worn_mm: f64 = 0.0,
        /// How far the body turns while the camera reads its rows, one after the other.
        #[range(0.0..=45.0)]
        #[source(structural)]
        read_deg: f64 = 0.0,
        /// How many photos are from step to step, as the cameras and the sway have it: above 1, feet are set and keep their
        /// places on the floor while the body turns over them, and all that moves does so smoothly, as in a film.
        #[range(1..=720)]
        #[source(structural)]
        pace: u32 = 1,
        /// How far feet are lifted in a film.
        #[range(0.0..=500.0)]
        #[source(structural)]
        lift_mm: f64 = 0.0,
        /// The share of the time from photo to photo in which rows are read, in a film.
        #[range(0.0..=1.0)]
        #[source(structural)]
        read: f64 = 0.0,
        /// The share of the time from photo to photo in which the shutter is open, in a film.
        #[range(0.0..=1.0)]
        #[source(structural)]
        open: f64 = 0.0,
        /// Seed of textures and noise.
        #[range(0..=1000000)]
        #[chance(seed)]
        #[source(structural)]
        seed: u32 = 1,
    }
}
