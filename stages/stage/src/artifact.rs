//! What flows between stages, and its layout in a file.
//!
//! ```text
//! 0   magic "TAILORAF"          8 bytes
//! 8   container version          u32, little-endian as all that follows
//! 12  length of the header       u32
//! 16  length of the whole file   u64
//! 24  header                     kind, format, metadata, table of sections (bincode, see codec.rs)
//! ..  sections                   raw arrays, each at a multiple of 64 bytes
//! ```

use crate::codec::{self, Corrupt};
use bytemuck::Pod;
use serde::{Deserialize, Serialize, de::DeserializeOwned};

pub use blake3::{Hash, hash};

/// The format's name, whatever program writes it. A result is named by the hash of all its bytes, these
/// eight with them: another number would give every result another name, and no cache would hit.
const MAGIC: &[u8; 8] = b"TAILORAF";
/// Version of the form (structural: the file's form).
const CONTAINER: u32 = 1;
/// Bytes before the content (structural: the file's form).
const PREFIX: usize = 24;
/// Where content begins (structural: the file's form).
const ALIGN: usize = 64;

/// A noun that flows from stage to stage.
pub trait Artifact: Send + Sync + Sized + 'static {
    /// What it is called: `masks`.
    const KIND: &'static str;
    /// Raise it whenever `pack` writes other bytes for equal content.
    const FORMAT: u32;
    /// To metadata and sections. Equal content must give equal bytes.
    fn pack(&self, to: &mut Packer);
    /// Back. Must check all it relies on: the bytes may come from anywhere.
    ///
    /// # Errors
    ///
    /// The bytes are not those of this kind, or are cut short.
    fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt>;
}

#[derive(Serialize, Deserialize)]
struct Header {
    kind: String,
    format: u32,
    meta: Vec<u8>,
    sections: Vec<Section>,
}

#[derive(Serialize, Deserialize)]
struct Section {
    name: String,
    element_bytes: u32,
    offset: u64,
    bytes: u64,
}

/// Takes an artifact apart into metadata and raw arrays.
#[derive(Default)]
pub struct Packer {
    meta: Vec<u8>,
    sections: Vec<(String, usize, Vec<u8>)>,
}

impl Packer {
    /// The typed metadata: once per artifact, small.
    pub fn meta(&mut self, meta: &impl Serialize) {
        self.meta = codec::encode(meta);
    }

    /// An array of plain numbers, under a name of its own.
    pub fn section<T: Pod>(&mut self, name: impl Into<String>, data: &[T]) {
        self.sections.push((
            name.into(),
            size_of::<T>(),
            bytemuck::cast_slice(data).to_vec(),
        ));
    }
}

/// Puts an artifact together again.
pub struct Unpacker<'a> {
    header: Header,
    bytes: &'a [u8],
}

impl Unpacker<'_> {
    /// Kind and format, as the bytes name them.
    pub fn kind(&self) -> (&str, u32) {
        (&self.header.kind, self.header.format)
    }

    /// The arrays: name, size of an element, and where they are in the bytes.
    pub fn sections(&self) -> impl Iterator<Item = (&str, usize, std::ops::Range<usize>)> {
        let place = |s: &Section| s.offset as usize..(s.offset + s.bytes) as usize;
        let sections = self.header.sections.iter();
        sections.map(move |s| (s.name.as_str(), s.element_bytes as usize, place(s)))
    }

    /// The typed metadata.
    ///
    /// # Errors
    ///
    /// The metadata is of another form.
    pub fn meta<T: DeserializeOwned>(&self) -> Result<T, Corrupt> {
        codec::decode(&self.header.meta)
    }

    /// An array of plain numbers.
    ///
    /// # Errors
    ///
    /// There is no such section, or its length is no multiple of an entry's.
    pub fn section<T: Pod>(&self, name: &str) -> Result<Vec<T>, Corrupt> {
        let section = self.header.sections.iter().find(|s| s.name == name);
        let section = section.ok_or_else(|| Corrupt(format!("no section `{name}`")))?;
        if section.element_bytes as usize != size_of::<T>() {
            return Err(Corrupt(format!(
                "section `{name}` has elements of another size"
            )));
        }
        let range = section.offset as usize..(section.offset + section.bytes) as usize;
        Ok(bytemuck::pod_collect_to_vec(&self.bytes[range]))
    }
}

/// The artifact as the bytes of its file.
pub fn to_bytes<A: Artifact>(artifact: &A) -> Vec<u8> {
    let mut packer = Packer::default();
    artifact.pack(&mut packer);
    let Packer { meta, sections } = packer;
    let mut header = Header {
        kind: A::KIND.into(),
        format: A::FORMAT,
        meta,
        sections: vec![],
    };
    for (name, element, data) in &sections {
        let (element_bytes, bytes) = (*element as u32, data.len() as u64);
        header.sections.push(Section {
            name: name.clone(),
            element_bytes,
            offset: 0,
            bytes,
        });
    }
    // Offsets have a fixed width, so the header's length is known before they are.
    let header_len = codec::encode(&header).len();
    let mut end = PREFIX + header_len;
    for section in &mut header.sections {
        section.offset = end.next_multiple_of(ALIGN) as u64;
        end = section.offset as usize + section.bytes as usize;
    }
    let mut bytes = Vec::with_capacity(end);
    bytes.extend_from_slice(MAGIC);
    bytes.extend_from_slice(&CONTAINER.to_le_bytes());
    bytes.extend_from_slice(&(header_len as u32).to_le_bytes());
    bytes.extend_from_slice(&(end as u64).to_le_bytes());
    bytes.extend_from_slice(&codec::encode(&header));
    // Each array goes as soon as it is written: a large artifact is in memory twice, not three times.
    for (section, (_, _, data)) in header.sections.iter().zip(sections) {
        bytes.resize(section.offset as usize, 0);
        bytes.extend_from_slice(&data);
    }
    bytes
}

/// The artifact from the bytes of its file, every length checked before it is used.
///
/// # Errors
///
/// The bytes are no artifact, of another kind, or corrupt.
pub fn from_bytes<A: Artifact>(bytes: &[u8]) -> Result<A, Corrupt> {
    let file = opened(bytes)?;
    let Header { kind, format, .. } = &file.header;
    if kind != A::KIND || *format != A::FORMAT {
        let wants = format!("{} format {}", A::KIND, A::FORMAT);
        return Err(Corrupt(format!(
            "holds {kind} format {format}, not {wants}"
        )));
    }
    A::unpack(&file)
}

/// The bytes of an artifact's file, of any kind, every length checked.
///
/// # Errors
///
/// The bytes are no artifact, or corrupt.
pub fn opened(bytes: &[u8]) -> Result<Unpacker<'_>, Corrupt> {
    let bad = |what: &str| Corrupt(what.into());
    let at = |range: std::ops::Range<usize>| bytes.get(range).ok_or_else(|| bad("too short"));
    if at(0..8)? != MAGIC {
        return Err(bad("no artifact file of ours"));
    }
    let u32_at = |i: usize| at(i..i + 4).map(|b| u32::from_le_bytes(b.try_into().expect("4")));
    if u32_at(8)? != CONTAINER {
        return Err(bad("written by another version of the program"));
    }
    let total = u64::from_le_bytes(at(16..24)?.try_into().expect("8"));
    if total != bytes.len() as u64 {
        return Err(Corrupt(format!(
            "{} bytes where {total} were written",
            bytes.len()
        )));
    }
    let header: Header = codec::decode(at(PREFIX..PREFIX + u32_at(12)? as usize)?)?;
    for s in &header.sections {
        let end = s.offset.checked_add(s.bytes).filter(|end| *end <= total);
        if end.is_none() || s.element_bytes == 0 || s.bytes % u64::from(s.element_bytes) != 0 {
            return Err(Corrupt(format!(
                "section `{}` reaches outside the file",
                s.name
            )));
        }
    }
    Ok(Unpacker { header, bytes })
}

/// The hash of an artifact's content: of the bytes of its file.
pub fn content<A: Artifact>(artifact: &A) -> Hash {
    blake3::hash(&to_bytes(artifact))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, PartialEq)]
    struct Noun(String, Vec<f32>);
    impl Artifact for Noun {
        const KIND: &'static str = "noun";
        const FORMAT: u32 = 1;
        fn pack(&self, to: &mut Packer) {
            to.meta(&self.0);
            to.section("numbers", &self.1);
        }
        fn unpack(from: &Unpacker<'_>) -> Result<Self, Corrupt> {
            Ok(Noun(from.meta()?, from.section("numbers")?))
        }
    }

    #[test]
    fn what_is_packed_is_unpacked() {
        let noun = Noun("a body".into(), vec![1.0, -0.0, f32::MAX]);
        assert_eq!(from_bytes::<Noun>(&to_bytes(&noun)), Ok(noun));
    }

    #[test]
    fn sections_are_where_the_head_puts_them() {
        let bytes = to_bytes(&Noun("a body".into(), vec![1.0, 2.5]));
        let file = opened(&bytes).unwrap();
        let sections: Vec<_> = file.sections().collect();
        let [(name, element, place)] = &sections[..] else {
            panic!("{sections:?}")
        };
        assert_eq!((file.kind(), *name, *element), (("noun", 1), "numbers", 4));
        assert_eq!(bytes[place.clone()], *bytemuck::bytes_of(&[1.0f32, 2.5]));
        assert_eq!(place.start % ALIGN, 0);
    }

    #[test]
    fn a_truncated_file_is_an_error_at_every_length() {
        let bytes = to_bytes(&Noun("a body".into(), vec![1.0; 40]));
        for end in 0..bytes.len() {
            assert!(from_bytes::<Noun>(&bytes[..end]).is_err(), "{end}");
        }
    }

    #[test]
    fn a_hostile_byte_is_an_error_or_another_noun_but_no_panic() {
        let bytes = to_bytes(&Noun("a body".into(), vec![1.0; 40]));
        for i in 0..bytes.len() {
            for value in [0, 1, 0x7f, 0xff] {
                let mut bytes = bytes.clone();
                bytes[i] = value;
                let _ = from_bytes::<Noun>(&bytes);
            }
        }
    }
}
