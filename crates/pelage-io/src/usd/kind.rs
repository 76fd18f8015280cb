//! Types of the values of `.usdc` files by number, from `pxr/usd/usd/crateDataTypes.h`.

pub(super) const STRING: u8 = 10;
pub(super) const TOKEN: u8 = 11;
pub(super) const ASSET_PATH: u8 = 12;
pub(super) const DICTIONARY: u8 = 31;
pub(super) const TOKEN_LIST_OP: u8 = 32;
pub(super) const STRING_LIST_OP: u8 = 33;
pub(super) const PATH_LIST_OP: u8 = 34;
pub(super) const REFERENCE_LIST_OP: u8 = 35;
pub(super) const INT_LIST_OP: u8 = 36;
pub(super) const INT64_LIST_OP: u8 = 37;
pub(super) const UINT_LIST_OP: u8 = 38;
pub(super) const UINT64_LIST_OP: u8 = 39;
pub(super) const PATH_VECTOR: u8 = 40;
pub(super) const TOKEN_VECTOR: u8 = 41;
pub(super) const VARIANT_SELECTION_MAP: u8 = 45;
pub(super) const TIME_SAMPLES: u8 = 46;
pub(super) const PAYLOAD: u8 = 47;
pub(super) const DOUBLE_VECTOR: u8 = 48;
pub(super) const LAYER_OFFSET_VECTOR: u8 = 49;
pub(super) const STRING_VECTOR: u8 = 50;
pub(super) const UNREGISTERED_LIST_OP: u8 = 54;
pub(super) const PAYLOAD_LIST_OP: u8 = 55;
pub(super) const TIME_CODE: u8 = 56;
pub(super) const PATH_EXPRESSION: u8 = 57;
pub(super) const RELOCATES: u8 = 58;

/// Whether arrays of this type hold real numbers.
pub(super) fn is_real(kind: u8) -> bool {
    matches!(kind, 7..=9 | TIME_CODE | DOUBLE_VECTOR)
}

/// Whether arrays of this type may be packed: integers and real numbers.
pub(super) fn is_packable(kind: u8) -> bool {
    matches!(kind, 3..=6) || is_real(kind)
}

/// Bytes of an entry of an array in the file.
pub(super) fn element_size(kind: u8) -> Option<u64> {
    Some(match kind {
        1 | 2 => 1,
        7 => 2,
        3 | 4 | 8 => 4,
        5 | 6 | 9 | TIME_CODE | DOUBLE_VECTOR => 8,
        // Matrices of 2, 3 and 4 rows of doubles.
        13 => 32,
        14 => 72,
        15 => 128,
        // Quaternions of doubles, floats and halves.
        16 => 32,
        17 => 16,
        18 => 8,
        // Vectors of 2, 3 and 4: doubles, floats, halves, integers.
        19..=30 => {
            let components = 2 + (kind as u64 - 19) / 4;
            components * [8, 4, 2, 4][(kind as usize - 19) % 4]
        }
        _ => return None,
    })
}
