//! The first tags of the family 36h11 (Olson 2011), as data: © the Regents of the University of Michigan,
//! BSD-2-Clause, from AprilTag 3.

/// Where each bit lies in the tag's 8×8 modules, from the most significant on: column, row.
#[rustfmt::skip]
const PLACES: [(usize, usize); 36] = [
    (1, 1), (2, 1), (3, 1), (4, 1), (5, 1), (2, 2), (3, 2), (4, 2), (3, 3),
    (6, 1), (6, 2), (6, 3), (6, 4), (6, 5), (5, 2), (5, 3), (5, 4), (4, 3),
    (6, 6), (5, 6), (4, 6), (3, 6), (2, 6), (5, 5), (4, 5), (3, 5), (4, 4),
    (1, 6), (1, 5), (1, 4), (1, 3), (1, 2), (2, 5), (2, 4), (2, 3), (3, 4),
];

/// Whether each of a tag's 8×8 modules is white, row by row from its top left as printed. `None` for
/// a tag that is not among these.
pub(crate) fn modules(id: u32) -> Option<[[bool; 8]; 8]> {
    let code = CODES.get(id as usize)?;
    let mut white = [[false; 8]; 8];
    for (i, (x, y)) in PLACES.iter().enumerate() {
        white[7 - *y][7 - *x] = code >> (35 - i) & 1 == 1;
    }
    Some(white)
}

#[rustfmt::skip]
const CODES: [u64; 64] = [
    0xd7e00984b, 0xdda664ca7, 0xdc4a1c821, 0xe17b470e9, 0xef91d01b1, 0xf429cdd73,
    0x05da29225, 0x1106cba43, 0x223bed79d, 0x21f51213c, 0x33eb19ca6, 0x3f76eb0f8,
    0x469a97414, 0x45dcfe0b0, 0x4a6465f72, 0x51801db96, 0x5eb946b4e, 0x68a7cc2ec,
    0x6f0ba2652, 0x78765559d, 0x87b83d129, 0x86cc4a5c5, 0x8b64df90f, 0x9c577b611,
    0xa3810f2f5, 0xaf4d75b83, 0xb59a03fef, 0xbb1096f85, 0xd1b92fc76, 0xd0dd509d2,
    0xe2cfda160, 0x2ff497c63, 0x47240671b, 0x5047a2e55, 0x635ca87c7, 0x691254166,
    0x68f43d94a, 0x6ef24bdb6, 0x8cdd8f886, 0x9de96b718, 0xaff6e5a8a, 0xbae46f029,
    0xd225b6d59, 0xdf8ba8c01, 0xe3744a22f, 0xfbb59375d, 0x18a916828, 0x22f29c1ba,
    0x286887d58, 0x41392322e, 0x75d18ecd1, 0x87c302743, 0x8c6317ba9, 0x9e40f36d7,
    0xc0e5a806a, 0xcc78cb87c, 0x12d2f2d01, 0x379f36a21, 0x6973f59ac, 0x7789ea9f4,
    0x8f1c73e84, 0x8dd287a20, 0x94a4eee4c, 0xa455379b5,
];
