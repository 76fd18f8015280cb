//! Polygons as files give them, and triangles as the generator needs them.

/// A polygon mesh as read from a file: nothing checked, nothing computed.
///
/// Corners are listed face after face; `corner_*` arrays have one entry a corner.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PolygonMesh {
    /// Vertex positions.
    pub positions: Vec<[f32; 3]>,
    /// Number of corners of each face.
    pub face_sizes: Vec<u32>,
    /// Vertex of each corner.
    pub corner_vertices: Vec<u32>,
    /// Texture coordinates of each corner, origin lower left; empty for none.
    pub corner_uvs: Vec<[f32; 2]>,
    /// Normal of each corner; empty for none.
    pub corner_normals: Vec<[f32; 3]>,
}

/// Why polygons are no surface.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MeshError {
    /// No face with three corners.
    #[error("the mesh has no triangle")]
    Empty,
    /// A corner names a vertex that does not exist.
    #[error("face {face} names vertex {vertex}; the mesh has {vertices} vertices")]
    NoSuchVertex {
        /// Face.
        face: usize,
        /// Vertex named.
        vertex: u32,
        /// Vertices there are.
        vertices: usize,
    },
    /// A position, normal or texture coordinate that is NaN or infinite.
    #[error("{array} {index} is {value}; it must be finite")]
    NotFinite {
        /// Which array.
        array: &'static str,
        /// Entry of the array.
        index: usize,
        /// What was found, as text.
        value: String,
    },
    /// An array does not match the faces.
    #[error("{array} has {found} entries, not {expected}")]
    WrongCount {
        /// Which array.
        array: &'static str,
        /// Entries found.
        found: usize,
        /// Entries expected.
        expected: usize,
    },
    /// More triangles or vertices than 32-bit indices can tell apart.
    #[error("the mesh has {found} {what}; at most {limit} are supported")]
    TooLarge {
        /// Of what.
        what: &'static str,
        /// How many.
        found: usize,
        /// How many are allowed.
        limit: usize,
    },
}

/// A triangle mesh ready to grow hair: see [`Mesh::new`].
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Vertex positions.
    pub positions: Vec<[f32; 3]>,
    /// Vertices of each triangle, in the order of the faces they came from.
    pub triangles: Vec<[u32; 3]>,
    /// Unit normal at each corner of each triangle.
    pub normals: Vec<[[f32; 3]; 3]>,
    /// Texture coordinates at each corner of each triangle; empty for none.
    pub uvs: Vec<[[f32; 2]; 3]>,
    /// Unit tangent at each corner of each triangle, along +u where there are UVs.
    pub tangents: Vec<[[f32; 3]; 3]>,
}
