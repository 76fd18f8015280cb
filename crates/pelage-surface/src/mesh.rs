//! Polygons as files give them, and triangles as the generator needs them.

use crate::triangulate::triangulate;
use crate::{normals, tangents};
use pelage_curves::{Vec2, Vec3};

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
    #[error("{array} {index} is NaN or infinite")]
    NotFinite {
        /// Which array.
        array: &'static str,
        /// Entry of the array.
        index: usize,
    },
    /// A vertex so far from the origin that lengths overflow.
    #[error(
        "vertex {index} is at {position}; coordinates go up to {limit:e} here: scale the mesh down",
        limit = Mesh::FARTHEST
    )]
    TooFar {
        /// Entry of the positions.
        index: usize,
        /// Where it is, as text.
        position: String,
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
    /// A pose does not have the rest mesh's faces.
    #[error("{what}{} is {posed}, but {rest} in the rest mesh; topology must be the same",
        .index.map(|i| format!(" {i}")).unwrap_or_default())]
    Topology {
        /// What differs.
        what: &'static str,
        /// Which one, where there are several.
        index: Option<usize>,
        /// Value at rest.
        rest: usize,
        /// Value in the pose.
        posed: usize,
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

/// A triangle mesh ready to grow hair.
///
/// Triangles keep the order of the faces they come from, and a polygon's triangles
/// follow each other. The index of a triangle here is the `triangle` of a root.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    positions: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    /// Which corner of the polygons each triangle corner is.
    corners: Vec<[u32; 3]>,
    normals: Vec<[Vec3; 3]>,
    uvs: Vec<[Vec2; 3]>,
    tangents: Vec<[Vec3; 3]>,
    degenerate: usize,
    face_sizes: Vec<u32>,
    face_vertices: Vec<u32>,
}

impl Mesh {
    /// The largest coordinate of a vertex, in the unit of the mesh: squares of lengths
    /// still fit an f32.
    pub const FARTHEST: f32 = 1e18;

    /// Checks `polygons`, triangulates them (concave ones too), computes normals
    /// where the file has none (angle-weighted over the faces that share a vertex)
    /// and tangents (along +u; without UVs along the first edge of each triangle).
    ///
    /// Faces of fewer than three corners are left out.
    pub fn new(polygons: PolygonMesh) -> Result<Self, MeshError> {
        check(&polygons)?;
        let positions: Vec<Vec3> = bytemuck::cast_slice(&polygons.positions).to_vec();
        let corners = triangulate(&positions, &polygons.face_sizes, &polygons.corner_vertices);
        if corners.is_empty() {
            return Err(MeshError::Empty);
        }
        let uvs = pick(&corners, bytemuck::cast_slice(&polygons.corner_uvs));
        let mut mesh = Self {
            triangles: pick(&corners, &polygons.corner_vertices),
            positions,
            normals: Vec::new(),
            tangents: Vec::new(),
            degenerate: 0,
            corners,
            uvs,
            face_sizes: polygons.face_sizes,
            face_vertices: polygons.corner_vertices,
        };
        mesh.degenerate = (0..mesh.triangles.len())
            .filter(|&t| mesh.area(t) <= 0.0)
            .count();
        mesh.finish(bytemuck::cast_slice(&polygons.corner_normals));
        Ok(mesh)
    }

    /// The same surface in another pose: its positions (and normals, where both
    /// this mesh and the pose have them from a file) with this mesh's triangles and
    /// UVs. Fails where the topology differs, and says where first.
    ///
    /// `keep_file_normals` tells whether normals of `pose` may be used; set it only
    /// where the rest mesh uses its file's normals too, so that a rigid motion
    /// moves every frame rigidly.
    pub fn posed(&self, pose: &PolygonMesh, keep_file_normals: bool) -> Result<Self, MeshError> {
        check(pose)?;
        self.check_topology(pose)?;
        let mut mesh = Self {
            positions: bytemuck::cast_slice(&pose.positions).to_vec(),
            ..self.clone()
        };
        let normals: &[Vec3] = bytemuck::cast_slice(&pose.corner_normals);
        mesh.finish(if keep_file_normals { normals } else { &[] });
        Ok(mesh)
    }

    fn check_topology(&self, pose: &PolygonMesh) -> Result<(), MeshError> {
        let differ = |what, index, rest: usize, posed: usize| {
            Err(MeshError::Topology {
                what,
                index,
                rest,
                posed,
            })
        };
        if self.positions.len() != pose.positions.len() {
            return differ(
                "number of vertices",
                None,
                self.positions.len(),
                pose.positions.len(),
            );
        }
        if self.face_sizes.len() != pose.face_sizes.len() {
            return differ(
                "number of faces",
                None,
                self.face_sizes.len(),
                pose.face_sizes.len(),
            );
        }
        let sizes = self.face_sizes.iter().zip(&pose.face_sizes);
        if let Some((face, (a, b))) = sizes.enumerate().find(|(_, (a, b))| a != b) {
            return differ(
                "number of corners of face",
                Some(face),
                *a as usize,
                *b as usize,
            );
        }
        let vertices = self.face_vertices.iter().zip(&pose.corner_vertices);
        if let Some((corner, (a, b))) = vertices.enumerate().find(|(_, (a, b))| a != b) {
            return differ(
                "vertex of face corner",
                Some(corner),
                *a as usize,
                *b as usize,
            );
        }
        Ok(())
    }

    fn finish(&mut self, corner_normals: &[Vec3]) {
        self.normals = if corner_normals.is_empty() {
            normals::angle_weighted(&self.positions, &self.triangles)
        } else {
            let file = pick(&self.corners, corner_normals);
            normals::repaired(file, &self.positions, &self.triangles)
        };
        self.tangents =
            tangents::corner_tangents(&self.positions, &self.triangles, &self.uvs, &self.normals);
    }

    /// Vertex positions.
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// Vertices of each triangle.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Unit normal at each corner of each triangle.
    #[inline]
    pub fn normals(&self) -> &[[Vec3; 3]] {
        &self.normals
    }

    /// Texture coordinates at each corner of each triangle; empty without UVs.
    #[inline]
    pub fn uvs(&self) -> &[[Vec2; 3]] {
        &self.uvs
    }

    /// Unit tangent at each corner of each triangle.
    #[inline]
    pub fn tangents(&self) -> &[[Vec3; 3]] {
        &self.tangents
    }

    /// Whether the mesh has texture coordinates.
    pub fn has_uvs(&self) -> bool {
        !self.uvs.is_empty()
    }

    /// Triangles without area; they grow no hair.
    pub fn degenerate_triangles(&self) -> usize {
        self.degenerate
    }

    /// Corner positions of triangle `triangle`.
    #[inline]
    pub fn corners(&self, triangle: usize) -> [Vec3; 3] {
        self.triangles[triangle].map(|v| self.positions[v as usize])
    }

    /// Area of triangle `triangle`, computed in f64.
    #[inline]
    pub fn area(&self, triangle: usize) -> f64 {
        area(self.corners(triangle))
    }

    /// Area of all triangles together, summed in their order.
    pub fn surface_area(&self) -> f64 {
        (0..self.triangles.len()).map(|t| self.area(t)).sum()
    }

    /// [`corners`](Self::corners) of `N` triangles from `first` on, or of the last where there
    /// are fewer: of each corner all x, all y, all z.
    #[inline(always)]
    pub(crate) fn all_corners<const N: usize>(&self, first: usize) -> [[[f32; N]; 3]; 3] {
        let last = self.triangles.len() - 1;
        let mut corners = [[[0.0; N]; 3]; 3];
        for k in 0..N {
            let vertices = self.triangles[(first + k).min(last)];
            for ([x, y, z], vertex) in corners.iter_mut().zip(vertices) {
                [x[k], y[k], z[k]] = self.positions[vertex as usize].to_array();
            }
        }
        corners
    }

    /// [`area`](Self::area) of the triangles that [`all_corners`](Self::all_corners) gives: the
    /// arithmetic runs at once.
    #[inline(always)]
    pub(crate) fn areas<const N: usize>(&self, first: usize) -> [f64; N] {
        let corners: [[[f32; N]; 3]; 3] = self.all_corners(first);
        let mut areas = [0.0; N];
        for (k, one) in areas.iter_mut().enumerate() {
            let [a, b, c] = &corners;
            *one = area([a, b, c].map(|[x, y, z]| Vec3::new(x[k], y[k], z[k])));
        }
        areas
    }

    /// Smallest and largest coordinates of the vertices that triangles use.
    pub fn bounds(&self) -> (Vec3, Vec3) {
        // Each corner by itself, so that one comparison does not wait for the one before.
        let mut bounds = [(Vec3::INFINITY, Vec3::NEG_INFINITY); 3];
        for corners in &self.triangles {
            for ((low, high), &vertex) in bounds.iter_mut().zip(corners) {
                let position = self.positions[vertex as usize];
                (*low, *high) = (low.min(position), high.max(position));
            }
        }
        let [a, b, c] = bounds;
        (a.0.min(b.0).min(c.0), a.1.max(b.1).max(c.1))
    }
}

#[inline(always)]
fn area(corners: [Vec3; 3]) -> f64 {
    let [a, b, c] = corners.map(|p| p.as_dvec3());
    (b - a).cross(c - a).length() / 2.0
}

/// The entries of `array` (one a polygon corner) for each triangle corner.
fn pick<T: Copy>(corners: &[[u32; 3]], array: &[T]) -> Vec<[T; 3]> {
    if array.is_empty() {
        return Vec::new();
    }
    corners
        .iter()
        .map(|t| t.map(|c| array[c as usize]))
        .collect()
}

fn check(mesh: &PolygonMesh) -> Result<(), MeshError> {
    let corners: usize = mesh.face_sizes.iter().map(|&n| n as usize).sum();
    let counts = [
        ("corner_vertices", mesh.corner_vertices.len(), corners),
        ("corner_uvs", mesh.corner_uvs.len(), corners),
        ("corner_normals", mesh.corner_normals.len(), corners),
    ];
    for (array, found, expected) in counts {
        let optional = array != "corner_vertices";
        if found != expected && !(optional && found == 0) {
            return Err(MeshError::WrongCount {
                array,
                found,
                expected,
            });
        }
    }
    let limit = u32::MAX as usize;
    if corners > limit {
        return Err(MeshError::TooLarge {
            what: "face corners",
            found: corners,
            limit,
        });
    }
    let vertices = mesh.positions.len();
    let mut corner = 0;
    for (face, &size) in mesh.face_sizes.iter().enumerate() {
        for &vertex in &mesh.corner_vertices[corner..corner + size as usize] {
            if vertex as usize >= vertices {
                return Err(MeshError::NoSuchVertex {
                    face,
                    vertex,
                    vertices,
                });
            }
        }
        corner += size as usize;
    }
    finite("vertex", mesh.positions.iter().map(|p| &p[..]))?;
    let far = |p: &[f32; 3]| p.iter().any(|c| c.abs() > Mesh::FARTHEST);
    if let Some(index) = mesh.positions.iter().position(far) {
        let [x, y, z] = mesh.positions[index];
        return Err(MeshError::TooFar {
            index,
            position: format!("({x:?}, {y:?}, {z:?})"),
        });
    }
    finite("texture coordinate", mesh.corner_uvs.iter().map(|p| &p[..]))?;
    finite("normal", mesh.corner_normals.iter().map(|p| &p[..]))
}

fn finite<'a>(
    array: &'static str,
    mut values: impl Iterator<Item = &'a [f32]>,
) -> Result<(), MeshError> {
    match values.position(|v| v.iter().any(|x| !x.is_finite())) {
        None => Ok(()),
        Some(index) => Err(MeshError::NotFinite { array, index }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square() -> PolygonMesh {
        PolygonMesh {
            positions: vec![
                [0.0, 0.0, 0.0],
                [1.0, 0.0, 0.0],
                [1.0, 1.0, 0.0],
                [0.0, 1.0, 0.0],
            ],
            face_sizes: vec![4],
            corner_vertices: vec![0, 1, 2, 3],
            ..Default::default()
        }
    }

    #[test]
    fn a_square_becomes_two_triangles_with_one_normal() {
        let mesh = Mesh::new(square()).unwrap();
        assert_eq!(mesh.triangles().len(), 2);
        assert!(
            mesh.normals()
                .iter()
                .flatten()
                .all(|n| n.distance(Vec3::Z) < 1e-6)
        );
        assert!((mesh.area(0) + mesh.area(1) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn a_concave_polygon_keeps_its_area() {
        // An arrow head: corner 3 is reflex.
        let mesh = Mesh::new(PolygonMesh {
            positions: vec![[0.0; 3], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [1.5, 0.5, 0.0]],
            face_sizes: vec![4],
            corner_vertices: vec![0, 1, 2, 3],
            ..Default::default()
        })
        .unwrap();
        let area = mesh.surface_area();
        assert!((area - 1.0).abs() < 1e-6, "{area}");
    }

    #[test]
    fn a_pose_of_other_topology_is_refused_with_the_place() {
        let mesh = Mesh::new(square()).unwrap();
        let mut pose = square();
        pose.corner_vertices[2] = 1;
        let error = mesh.posed(&pose, false).unwrap_err();
        assert_eq!(
            error.to_string(),
            "vertex of face corner 2 is 1, but 2 in the rest mesh; topology must be the same"
        );
    }

    #[test]
    fn bad_polygons_are_refused() {
        let mut mesh = square();
        mesh.corner_vertices[1] = 9;
        assert!(matches!(
            Mesh::new(mesh),
            Err(MeshError::NoSuchVertex { face: 0, .. })
        ));
        let mut mesh = square();
        mesh.positions[3][1] = f32::NAN;
        assert!(matches!(
            Mesh::new(mesh),
            Err(MeshError::NotFinite { index: 3, .. })
        ));
        let mut mesh = square();
        mesh.positions[2] = [0.0, -1e30, 0.5];
        assert_eq!(
            Mesh::new(mesh).unwrap_err().to_string(),
            "vertex 2 is at (0.0, -1e30, 0.5); coordinates go up to 1e18 here: \
            scale the mesh down"
        );
        let mut mesh = square();
        mesh.face_sizes = vec![2, 2];
        assert_eq!(Mesh::new(mesh).unwrap_err(), MeshError::Empty);
    }
}
