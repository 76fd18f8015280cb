//! What a mesh holds, and what is wrong with it as a surface that grows hair.

use crate::inspect::{Problem, Span, write_bounds, write_frames, write_problems, write_span};
use pelage_strands::{Bounds, Range};
use pelage_surface::PolygonMesh;
use serde::Serialize;
use std::collections::HashMap;
use std::fmt;

/// What a mesh holds.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MeshReport {
    /// Vertices.
    pub vertices: usize,
    /// Faces.
    pub faces: usize,
    /// Triangles that the faces make.
    pub triangles: usize,
    /// Corners of a face.
    pub corners_per_face: Option<Span>,
    /// Smallest and largest corner of the box around the vertices.
    pub bounds: Option<[[f32; 3]; 2]>,
    /// Smallest and largest texture coordinates; `None` where there are none.
    pub uv_range: Option<[[f32; 2]; 2]>,
    /// Whether there are normals.
    pub has_normals: bool,
    /// Edges that only one face has: none for a closed surface.
    pub open_edges: usize,
    /// Times at which positions are sampled; empty for a still.
    pub frames: Vec<f64>,
    /// What is wrong.
    pub problems: Vec<Problem>,
}

impl MeshReport {
    /// Looks at `mesh`; never panics, whatever its arrays hold.
    pub fn of(mesh: &PolygonMesh) -> Self {
        let mut problems = Vec::new();
        let mut bounds = Bounds::default();
        for (i, p) in mesh.positions.iter().enumerate() {
            bounds.add(*p, 0.0);
            if !p.iter().all(|x| x.is_finite()) {
                problems.push(Problem::new(
                    "position not finite",
                    Some(i),
                    format!("{p:?}"),
                ));
            }
        }
        let faces = sound_faces(mesh, &mut problems);
        let mut sizes = Range::default();
        mesh.face_sizes.iter().for_each(|&s| sizes.add(s as f64));
        degenerate_triangles(mesh, &faces, &mut problems);
        unused_vertices(mesh, &mut problems);
        let open_edges = edges(&faces, &mut problems);
        let uv_range = texture_coordinates(mesh, &mut problems);
        Self {
            vertices: mesh.positions.len(),
            faces: mesh.face_sizes.len(),
            triangles: faces.iter().map(|(_, f)| f.len() - 2).sum(),
            corners_per_face: Span::of(&sizes),
            bounds: (!bounds.is_empty()).then_some([bounds.min, bounds.max]),
            uv_range,
            has_normals: !mesh.corner_normals.is_empty(),
            open_edges,
            frames: Vec::new(),
            problems,
        }
    }
}

/// Faces that name existing vertices and have at least three corners, by number.
fn sound_faces<'a>(mesh: &'a PolygonMesh, problems: &mut Vec<Problem>) -> Vec<(usize, &'a [u32])> {
    let mut faces = Vec::new();
    let mut rest = &mesh.corner_vertices[..];
    for (face, &size) in mesh.face_sizes.iter().enumerate() {
        let Some((corners, after)) = rest.split_at_checked(size as usize) else {
            let detail = format!("{size} corners, but {} are left", rest.len());
            problems.push(Problem::new("missing corners", Some(face), detail));
            return faces;
        };
        rest = after;
        let vertices = mesh.positions.len();
        if let Some(v) = corners.iter().find(|&&v| v as usize >= vertices) {
            let detail = format!("face {face} names vertex {v} of {vertices}");
            problems.push(Problem::new("index out of range", Some(face), detail));
        } else if corners.len() < 3 {
            let detail = format!("{} corners", corners.len());
            problems.push(Problem::new("face without area", Some(face), detail));
        } else {
            faces.push((face, corners));
        }
    }
    if !rest.is_empty() {
        let detail = format!("{} corners belong to no face", rest.len());
        problems.push(Problem::new("missing corners", None, detail));
    }
    faces
}

/// Faces with a corner twice, or whose area is nothing beside their edges.
fn degenerate_triangles(
    mesh: &PolygonMesh,
    faces: &[(usize, &[u32])],
    problems: &mut Vec<Problem>,
) {
    for &(face, corners) in faces {
        let at = |i: usize| glam::Vec3::from(mesh.positions[corners[i] as usize]).as_dvec3();
        let (mut area, mut longest) = (glam::DVec3::ZERO, 0.0f64);
        for i in 1..corners.len() - 1 {
            let (a, b) = (at(i) - at(0), at(i + 1) - at(0));
            area += a.cross(b);
            longest = longest.max(a.length_squared()).max(b.length_squared());
        }
        if area.length() <= 1e-12 * longest || longest == 0.0 {
            let detail = format!("vertices {corners:?}");
            problems.push(Problem::new("face without area", Some(face), detail));
        }
    }
}

fn unused_vertices(mesh: &PolygonMesh, problems: &mut Vec<Problem>) {
    let mut used = vec![false; mesh.positions.len()];
    for &vertex in &mesh.corner_vertices {
        if let Some(used) = used.get_mut(vertex as usize) {
            *used = true;
        }
    }
    let unused = used.iter().enumerate().filter(|(_, used)| !**used);
    problems.extend(unused.map(|(i, _)| Problem::new("unused vertex", Some(i), "in no face")));
}

/// Counts open edges; edges of more than two faces are problems.
fn edges(faces: &[(usize, &[u32])], problems: &mut Vec<Problem>) -> usize {
    let mut uses: HashMap<(u32, u32), (u32, usize)> = HashMap::new();
    for &(face, corners) in faces {
        for (i, &a) in corners.iter().enumerate() {
            let b = corners[(i + 1) % corners.len()];
            let entry = uses.entry((a.min(b), a.max(b))).or_insert((0, face));
            entry.0 += 1;
        }
    }
    let mut crowded: Vec<_> = uses.iter().filter(|(_, (n, _))| *n > 2).collect();
    crowded.sort();
    for ((a, b), (count, face)) in crowded {
        let detail = format!("vertices {a} and {b} are an edge of {count} faces");
        problems.push(Problem::new("edge of many faces", Some(*face), detail));
    }
    uses.values().filter(|(n, _)| *n == 1).count()
}

fn texture_coordinates(mesh: &PolygonMesh, problems: &mut Vec<Problem>) -> Option<[[f32; 2]; 2]> {
    if mesh.corner_uvs.is_empty() {
        return None;
    }
    let (mut low, mut high) = ([f32::INFINITY; 2], [f32::NEG_INFINITY; 2]);
    for (corner, uv) in mesh.corner_uvs.iter().enumerate() {
        if !uv.iter().all(|x| x.is_finite()) {
            let detail = format!("corner {corner} has {uv:?}");
            problems.push(Problem::new(
                "texture coordinate not finite",
                Some(corner),
                detail,
            ));
        }
        for k in 0..2 {
            low[k] = low[k].min(uv[k]);
            high[k] = high[k].max(uv[k]);
        }
    }
    Some([low, high])
}

impl fmt::Display for MeshReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "mesh")?;
        writeln!(f, "  vertices         {}", self.vertices)?;
        writeln!(f, "  faces            {}", self.faces)?;
        writeln!(f, "  triangles        {}", self.triangles)?;
        write_span(f, "corners a face", &self.corners_per_face)?;
        write_bounds(f, &self.bounds)?;
        match self.uv_range {
            Some([low, high]) => writeln!(f, "  texture coords   {low:?} to {high:?}")?,
            None => writeln!(f, "  texture coords   none")?,
        }
        let normals = if self.has_normals { "yes" } else { "no" };
        writeln!(f, "  normals          {normals}")?;
        writeln!(f, "  open edges       {}", self.open_edges)?;
        write_frames(f, &self.frames)?;
        write_problems(f, &self.problems)
    }
}
