use super::*;
use pelage_curves::frenet::CatmullRom;
use pelage_curves::super_helix::{Goal, Settings, fit};
use proptest::prelude::*;

/// A curl of three turns and a straight line, a point, and a strand of no vertices.
fn strands() -> SuperHelices {
    let curl: Vec<DVec3> = (0..60)
        .map(|i| f64::from(i) / 59.0)
        .map(|t| DVec3::new(libm::cos(18.0 * t), libm::sin(18.0 * t), 9.0 * t + 1.0))
        .collect();
    let line = [DVec3::ZERO, DVec3::new(1.0, 2.0, 2.0)];
    let mut strands = SuperHelices {
        up_axis: Some(UpAxis::Z),
        meters_per_unit: Some(1.0),
        ..SuperHelices::default()
    };
    for points in [&curl[..], &line] {
        let target = CatmullRom::new(points).unwrap();
        let found = fit(&target, &Settings::new(Goal::RelativeError(0.01))).unwrap();
        let vertices = points.len() as u32;
        strands.push(&found.curve, vertices, found.worst).unwrap();
    }
    strands.push_point([1.0, 2.0, 3.0], 1);
    strands.push_point([0.0; 3], 0);
    strands
}

#[test]
fn every_form_gives_back_every_number() {
    let folder = tempfile::tempdir().unwrap();
    let written = strands();
    for extension in SUPER_HELIX_EXTENSIONS {
        let path = folder.path().join("fit.".to_owned() + extension);
        write_super_helices(&path, &written, &WriteOptions::default()).unwrap();
        let mut read = read_super_helices(&path).unwrap();
        if extension == "npz" {
            // NumPy arrays do not tell of space.
            (read.up_axis, read.meters_per_unit) = (written.up_axis, written.meters_per_unit);
        }
        assert_eq!(read, written, "{extension}");
    }
    let path = folder.path().join("fit.obj");
    let error = write_super_helices(&path, &written, &WriteOptions::default()).unwrap_err();
    assert!(
        error.to_string().contains(".obj; there are .json"),
        "{error}"
    );
}

#[test]
fn every_form_is_read_as_the_curves_that_it_decodes_to_whatever_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let written = strands();
    let decoded = written.decode(None);
    assert_eq!(decoded.offsets, [0, 60, 62, 63, 63]);
    for extension in ["json", "usdc", "npz"] {
        let path = folder.path().join("fit.".to_owned() + extension);
        write_super_helices(&path, &written, &WriteOptions::default()).unwrap();
        let other = folder.path().join(match extension {
            "json" => "other.curves",
            "usdc" => "other.usd",
            _ => "other.npz",
        });
        std::fs::rename(&path, &other).unwrap();
        let file = crate::read_curves(&other, None).unwrap();
        let read = crate::strands_through_vertices(&file.sets[0]);
        // USD has no curves of fewer than two vertices.
        let first = decoded.offsets[2] as usize;
        assert_eq!(read.points[..first], decoded.points[..first], "{extension}");
        assert!(file.sets[0].faults.is_empty());
    }
}

#[test]
fn another_number_of_vertices_is_on_the_same_curves() {
    let strands = strands();
    let decoded = strands.decode(Some(5));
    assert_eq!(decoded.offsets, [0, 5, 10, 11, 11]);
    let curve = strands.curve(0).unwrap();
    let half = curve.at(curve.length() / 2.0).position.as_vec3();
    assert_eq!(decoded.strand_points(0)[2], half);
}

#[test]
fn arrays_that_are_no_strands_are_refused_with_their_place() {
    let refused = |change: fn(&mut SuperHelices), place: &str| {
        let mut strands = strands();
        change(&mut strands);
        let wrong = strands.check().unwrap_err();
        assert!(wrong.to_string().contains(place), "{wrong} for {place}");
        let path = Path::new("fit.json");
        assert!(write_super_helices(path, &strands, &WriteOptions::default()).is_err());
    };
    refused(|s| s.offsets[1] = 9999, "elements: offsets");
    refused(|s| s.offsets.truncate(1), "elements: 0 entries for the 4");
    refused(|s| s.lengths.truncate(1), "length: 1 entries for");
    refused(|s| s.lengths[0] = -1.0, "elements of strand 0");
    refused(|s| s.twists[0] = f32::NAN, "elements of strand 0");
    refused(|s| s.roots[2][1] = f32::INFINITY, "root of strand 2");
    refused(|s| s.tangents[1] = [0.0; 3], "tangent of strand 1");
    refused(|s| s.normals[1] = s.tangents[1], "normal of strand 1");
    refused(|s| s.errors[0] = f32::NAN, "error of strand 0");
    refused(|s| s.vertices[3] = u32::MAX, "vertices of strand 3");
    refused(|s| s.vertices.truncate(1), "vertices: 1 entries");
}

proptest! {
    #[test]
    fn rounding_moves_a_curve_by_no_more_than_is_told(
        elements in prop::collection::vec(
            (0.01f64..2.0, prop::array::uniform3(-20.0f64..20.0)), 1..30),
        start in prop::array::uniform3(-1e3f64..1e3),
        axis in prop::array::uniform3(-1.0f64..1.0),
    ) {
        let elements: Vec<Element> = elements
            .into_iter()
            .map(|(length, [twist, a, b])| Element { length, twist, curvatures: [a, b] })
            .collect();
        let tangent = DVec3::from(axis).normalize_or(DVec3::Z);
        let normal = tangent.any_orthonormal_vector();
        let binormal = tangent.cross(normal);
        let frame = Frame { tangent, normal, binormal };
        let exact = SuperHelix::new(start.into(), frame, &elements).unwrap();
        let mut strands = SuperHelices::default();
        strands.push(&exact, 2, 0.0).unwrap();
        let kept = strands.curve(0).unwrap();
        for i in 0..=100 {
            let part = f64::from(i) / 100.0;
            let place = |c: &SuperHelix| c.at(part * c.length()).position;
            let moved = place(&exact).distance(place(&kept));
            prop_assert!(moved <= f64::from(strands.errors[0]) + 1e-12);
        }
        prop_assert!(f64::from(strands.errors[0]) < 1e-3 * exact.length().max(1.0));
    }
}
