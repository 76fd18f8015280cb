//! What is written is read back as the same strands.

#![allow(clippy::unwrap_used, reason = "helpers of tests are tests too")]

mod support;

use pelage_io::{WriteOptions, read_curves, strands_through_vertices};
use pelage_strands::{StrandBuffer, StreamInfo, UpAxis};
use support::{raised, strands, write};

/// `strands` with the attributes that USD files hold.
fn as_in_usd(strands: &StrandBuffer) -> StrandBuffer {
    StrandBuffer {
        normals: Vec::new(),
        triangle: Vec::new(),
        barycentric: Vec::new(),
        ..strands.clone()
    }
}

#[test]
fn every_format_that_is_read_gives_the_strands_back() {
    let folder = tempfile::tempdir().unwrap();
    let mut strands = strands(500);
    strands.opacities[99] = 0.5;
    strands.strand_uv[7] = [0.25, -0.25];
    let info = StreamInfo {
        up_axis: UpAxis::Z,
        meters_per_unit: 0.001,
        ..Default::default()
    };
    for format in ["usdc", "usda", "npz"] {
        let path = folder.path().join(format!("a.{format}"));
        let frames = std::slice::from_ref(&strands);
        write(&path, &WriteOptions::default(), &info, frames, 64).unwrap();
        let file = read_curves(&path, None).unwrap();
        let [set] = &file.sets[..] else {
            panic!("{format}: {} sets", file.sets.len())
        };
        assert!(set.faults.is_empty(), "{format}: {:?}", set.faults);
        let found = strands_through_vertices(set);
        if format == "npz" {
            assert!(found == strands, "{format}");
        } else {
            assert!(as_in_usd(&found) == as_in_usd(&strands), "{format}");
            assert_eq!(file.up_axis, Some(UpAxis::Z));
            assert_eq!(file.meters_per_unit, Some(0.001));
        }
    }
}

#[test]
fn frames_are_read_back_each_at_its_time() {
    let folder = tempfile::tempdir().unwrap();
    let first = strands(20);
    let frames = [first.clone(), raised(&first, 2.0)];
    let info = StreamInfo {
        frames: vec![10.0, 12.5],
        ..Default::default()
    };
    for format in ["usdc", "usda", "npz"] {
        let path = folder.path().join(format!("a.{format}"));
        write(&path, &WriteOptions::default(), &info, &frames, 8).unwrap();
        for (time, strands) in info.frames.iter().zip(&frames) {
            let file = read_curves(&path, Some(*time)).unwrap();
            assert_eq!(file.sets[0].frames, info.frames);
            let found = strands_through_vertices(&file.sets[0]);
            assert!(found.points == strands.points, "{format} at {time}");
            assert!(file.sets[0].faults.is_empty(), "{format} at {time}");
        }
        let between = read_curves(&path, Some(11.25)).unwrap();
        let between = strands_through_vertices(&between.sets[0]);
        // A rounding or two of heights up to 3.
        let off = |(a, b): (&[f32; 3], &[f32; 3])| (a[1] - b[1]).abs() > 1e-6;
        let expected = raised(&first, 1.0);
        let mut pairs = between.points.iter().zip(&expected.points);
        assert!(!pairs.any(off), "{format}");
    }
}
