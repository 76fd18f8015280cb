//! A chunk of strands made safe to write.
//!
//! A buffer's arrays are public and may disagree; and a curve of one vertex, which
//! no generator should make, brings readers down (Blender 5.0 crashes on cubic
//! curves of fewer than four control vertices). Writers look at chunks only
//! through [`drawable`], or [`checked`] where their files hold plain arrays.

use pelage_strands::StrandBuffer;
use std::borrow::Cow;
use std::io;

/// `strands` with every curve of at least two vertices: a curve of one vertex gets
/// it twice, a curve of none is left out. Borrowed where nothing needs to change.
///
/// Fails where offsets do not ascend from 0 to the number of points, or an array is
/// neither empty nor of its domain's length.
pub(crate) fn drawable(strands: &StrandBuffer) -> io::Result<Cow<'_, StrandBuffer>> {
    checked(strands)?;
    if (0..strands.len()).all(|strand| strands.vertex_count(strand) >= 2) {
        return Ok(Cow::Borrowed(strands));
    }
    Ok(Cow::Owned(mended(strands)))
}

/// `strands` as they are, refused where [`drawable`] refuses them.
pub(crate) fn checked(strands: &StrandBuffer) -> io::Result<&StrandBuffer> {
    check_offsets(strands)?;
    check_lengths(strands)?;
    Ok(strands)
}

fn check_offsets(strands: &StrandBuffer) -> io::Result<()> {
    let offsets = &strands.offsets;
    let ends_fit = offsets.first() == Some(&0)
        && offsets.last().map(|&end| end as usize) == Some(strands.points.len());
    if ends_fit && offsets.windows(2).all(|pair| pair[0] <= pair[1]) {
        return Ok(());
    }
    Err(refused(format!(
        "the strands' offsets must ascend from 0 to the number of points, {}",
        strands.points.len()
    )))
}

fn check_lengths(strands: &StrandBuffer) -> io::Result<()> {
    let (vertices, curves) = (strands.points.len(), strands.len());
    macro_rules! check { ($($name:ident: $expected:expr),* $(,)?) => { $(
        let found = strands.$name.len();
        if found != 0 && found != $expected {
            return Err(refused(format!(
                "{} has {found} entries where {} belong", stringify!($name), $expected
            )));
        }
    )* } }
    check!(
        widths: vertices, colors: vertices, opacities: vertices, normals: vertices,
        hair_id: curves, strand_id: curves, root_uv: curves, strand_uv: curves,
        group: curves, triangle: curves, barycentric: curves, root_rest: curves,
    );
    Ok(())
}

fn mended(strands: &StrandBuffer) -> StrandBuffer {
    let kept: Vec<usize> = (0..strands.len())
        .filter(|&strand| strands.vertex_count(strand) > 0)
        .collect();
    // Which vertices follow each other; a lone one follows itself.
    let mut vertices = Vec::with_capacity(strands.points.len());
    let mut mended = StrandBuffer::new();
    for &strand in &kept {
        let range = strands.vertices(strand);
        if range.len() == 1 {
            vertices.push(range.start);
        }
        vertices.extend(range);
        mended.offsets.push(vertices.len() as u32);
    }
    macro_rules! pick { ($($name:ident by $index:expr),* $(,)?) => { $(
        if !strands.$name.is_empty() {
            mended.$name = $index.iter().map(|&i| strands.$name[i]).collect();
        }
    )* } }
    pick!(
        points by vertices, widths by vertices, colors by vertices,
        opacities by vertices, normals by vertices, hair_id by kept, strand_id by kept,
        root_uv by kept, strand_uv by kept, group by kept, triangle by kept,
        barycentric by kept, root_rest by kept,
    );
    mended
}

/// An error that blames what was handed in rather than the disk.
pub(crate) fn refused(message: impl Into<String>) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, message.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn three_curves_of_1_0_and_2_vertices() -> StrandBuffer {
        StrandBuffer {
            offsets: vec![0, 1, 1, 3],
            points: vec![[1.0; 3], [2.0; 3], [3.0; 3]],
            widths: vec![0.1, 0.2, 0.3],
            hair_id: vec![10, 11, 12],
            ..Default::default()
        }
    }

    #[test]
    fn a_lone_vertex_is_doubled_and_a_curve_of_none_left_out() {
        let strands = three_curves_of_1_0_and_2_vertices();
        let mended = drawable(&strands).unwrap();
        assert_eq!(mended.offsets, [0, 2, 4]);
        assert_eq!(mended.points, [[1.0; 3], [1.0; 3], [2.0; 3], [3.0; 3]]);
        assert_eq!(mended.widths, [0.1, 0.1, 0.2, 0.3]);
        assert_eq!(mended.hair_id, [10, 12]);
        assert!(mended.colors.is_empty());
    }

    #[test]
    fn good_strands_are_not_copied() {
        let mut strands = three_curves_of_1_0_and_2_vertices();
        strands.offsets = vec![0, 3];
        strands.hair_id = vec![1];
        assert!(matches!(drawable(&strands), Ok(Cow::Borrowed(_))));
    }

    #[test]
    fn arrays_that_disagree_are_refused_by_name() {
        let mut strands = three_curves_of_1_0_and_2_vertices();
        strands.widths.pop();
        let error = drawable(&strands).unwrap_err().to_string();
        assert_eq!(error, "widths has 2 entries where 3 belong");
        strands.offsets = vec![0, 2, 1, 3];
        assert!(drawable(&strands).is_err());
        strands.offsets.clear();
        assert!(drawable(&strands).is_err());
    }
}
