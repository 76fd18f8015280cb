//! How a crate file says where a value is and of what type.

/// Types of values that we write, with their numbers in the format.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Kind {
    Int = 3,
    Int64 = 5,
    Float = 8,
    Double = 9,
    String = 10,
    Token = 11,
    Vec2f = 20,
    Vec3f = 24,
    TokenVector = 41,
    Specifier = 42,
    Variability = 44,
    TimeSamples = 46,
    DoubleVector = 48,
}

/// 64 bits for one value: bit 63 says array, bit 62 that the value itself is in the
/// low bits; bits 48–55 are the type and bits 0–47 the offset in the file, or the
/// value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ValueRep(pub(super) u64);

const ARRAY: u64 = 1 << 63;
const INLINED: u64 = 1 << 62;
const OFFSET: u64 = (1 << 48) - 1;

impl ValueRep {
    /// The value at `offset`.
    pub(super) fn at(kind: Kind, offset: u64) -> Self {
        debug_assert!(offset <= OFFSET, "files end long before 256 TiB");
        Self((kind as u64) << 48 | offset)
    }

    /// The array at `offset`; 0 means an empty one.
    pub(super) fn array(kind: Kind, offset: u64) -> Self {
        Self(Self::at(kind, offset).0 | ARRAY)
    }

    /// A small value, or an index into the tokens or strings.
    pub(super) fn inlined(kind: Kind, value: u32) -> Self {
        Self(Self::at(kind, value.into()).0 | INLINED)
    }
}
