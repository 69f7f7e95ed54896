//! Parts of a person that masks leave out, by photo.

use crate::{PhotoId, Region};
use stage::{Artifact, Corrupt, Packer, Unpacker};

/// A part of the body, by its joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BodyPart {
    /// Face and crown.
    Head,
    /// Shoulders to hips.
    Trunk,
    /// Both arms.
    Arms,
    /// Both legs, to the ankles.
    Legs,
    /// Both feet.
    Feet,
}

impl BodyPart {
    /// All of them.
    pub const ALL: [BodyPart; 5] = [
        BodyPart::Head,
        BodyPart::Trunk,
        BodyPart::Arms,
        BodyPart::Legs,
        BodyPart::Feet,
    ];

    /// Its word in files.
    pub fn word(self) -> &'static str {
        match self {
            BodyPart::Head => "head",
            BodyPart::Trunk => "trunk",
            BodyPart::Arms => "arms",
            BodyPart::Legs => "legs",
            BodyPart::Feet => "feet",
        }
    }

    /// The part that girths of a region go around; `None` where it is none of them alone.
    pub fn of(region: Region) -> Option<BodyPart> {
        match region {
            Region::Chest | Region::Waist | Region::Hip => Some(BodyPart::Trunk),
            Region::UpperArm | Region::Forearm => Some(BodyPart::Arms),
            Region::Thigh | Region::Calf => Some(BodyPart::Legs),
            Region::Neck | Region::Anywhere => None,
        }
    }
}

/// Where masks and a learned sense of a person contradict each other. Of a thing nothing.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LostParts {
    /// How many masks were compared.
    pub photos: u32,
    /// By part, in the order of [`BodyPart::ALL`]: photos whose mask leaves out some of it.
    pub lost: [Vec<PhotoId>; 5],
    /// Photos whose mask has body where no person is seen.
    pub added: Vec<PhotoId>,
}

impl LostParts {
    /// Photos whose mask leaves out some of a part.
    pub fn of(&self, part: BodyPart) -> &[PhotoId] {
        &self.lost[part as usize]
    }

    /// Whether most masks leave out some of a part: then no other photo makes up for it.
    pub fn mostly(&self, part: BodyPart) -> bool {
        2 * self.of(part).len() > self.photos as usize
    }
}

impl Artifact for LostParts {
    const KIND: &'static str = "lost_parts";
    const FORMAT: u32 = 1;

    fn pack(&self, to: &mut Packer) {
        let ids = |photos: &Vec<PhotoId>| photos.iter().map(|id| id.0).collect::<Vec<u32>>();
        let lost: Vec<Vec<u32>> = self.lost.iter().map(ids).collect();
        to.meta(&(self.photos, lost, ids(&self.added)));
    }

    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
        let (photos, lost, added): (u32, Vec<Vec<u32>>, Vec<u32>) = from.meta()?;
        let ids = |ids: Vec<u32>| ids.into_iter().map(PhotoId).collect::<Vec<PhotoId>>();
        let lost: Vec<Vec<PhotoId>> = lost.into_iter().map(ids).collect();
        Ok(LostParts {
            photos,
            lost: lost
                .try_into()
                .map_err(|_| Corrupt("another number of parts".into()))?,
            added: ids(added),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lost_parts_come_back_and_half_of_the_photos_are_not_most() {
        let mut parts = LostParts {
            photos: 4,
            added: vec![PhotoId(3)],
            ..LostParts::default()
        };
        parts.lost[BodyPart::Legs as usize] = vec![PhotoId(0), PhotoId(2)];
        let bytes = stage::to_bytes(&parts);
        assert_eq!(stage::from_bytes::<LostParts>(&bytes).unwrap(), parts);
        assert!(!parts.mostly(BodyPart::Legs));
        parts.lost[BodyPart::Legs as usize].push(PhotoId(3));
        assert!(parts.mostly(BodyPart::Legs) && !LostParts::default().mostly(BodyPart::Head));
        for at in 0..bytes.len() {
            let mut bytes = bytes.clone();
            bytes[at] ^= 0x55;
            let _ = stage::from_bytes::<LostParts>(&bytes);
        }
    }
}
