//! What every array format does with a stream: check it, count it, and gather it in
//! columns.

use crate::columns::{Column, Ends};
use crate::drawable::{checked, drawable, refused};
use pelage_strands::{Amount, Bounds, StrandBuffer, StreamInfo};
use std::borrow::Cow;
use std::io;

/// Counts of one frame; equal for every frame of a stream.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    /// Curves and vertices as written, doubled ends included.
    pub(crate) amount: Amount,
    /// Hash of the vertex counts in order, so that two frames whose totals agree
    /// by chance do not pass for equal.
    digest: u64,
}

impl Tally {
    fn add(&mut self, vertices: usize) {
        self.amount.strands += 1;
        self.amount.vertices += vertices as u64;
        // FNV-1a over whole counts.
        self.digest = (self.digest ^ vertices as u64).wrapping_mul(0x0000_0100_0000_01b3);
    }
}

/// Records a stream; see the module.
#[derive(Debug)]
pub(crate) struct Recorder {
    info: StreamInfo,
    ends: Ends,
    columns: Vec<Column>,
    /// Frames begun.
    frames: usize,
    first: Option<Tally>,
    now: Option<Tally>,
    extents: Vec<Bounds>,
    wants_extents: bool,
    scratch: Vec<u8>,
}

impl Recorder {
    /// A recorder of the stream `info` into `columns`.
    ///
    /// Fails where frames are not finite and ascending: files that store time
    /// search their samples.
    pub(crate) fn new(info: &StreamInfo, ends: Ends, columns: Vec<Column>) -> io::Result<Self> {
        let ascending = info.frames.windows(2).all(|pair| pair[0] < pair[1]);
        if !ascending || !info.frames.iter().all(|frame| frame.is_finite()) {
            return Err(refused("frames must be finite and ascend"));
        }
        Ok(Self {
            info: info.clone(),
            ends,
            columns,
            frames: 0,
            first: None,
            now: None,
            extents: Vec::new(),
            wants_extents: false,
            scratch: Vec::new(),
        })
    }

    /// Gathers the bounds of each frame as well.
    pub(crate) fn with_extents(mut self) -> Self {
        self.wants_extents = true;
        self
    }

    /// Opens the next frame.
    pub(crate) fn begin_frame(&mut self) -> io::Result<()> {
        if self.now.is_some() {
            return Err(refused("a frame began before the last one ended"));
        }
        if self.frames == self.expected_frames() {
            return Err(refused(format!(
                "only {} frames were announced",
                self.frames
            )));
        }
        self.frames += 1;
        self.now = Some(Tally::default());
        self.extents.push(Bounds::default());
        Ok(())
    }

    /// Records `strands`; gives them as they are to be written.
    ///
    /// The first strands of each frame tell which columns have values in it. These
    /// are handed to `place`, to get their places in a file, with what the frame
    /// brings at the most, as written; `None` where that is not known.
    pub(crate) fn take<'a>(
        &mut self,
        strands: &'a StrandBuffer,
        place: impl FnOnce(&mut [&mut Column], Option<Amount>),
    ) -> io::Result<Cow<'a, StrandBuffer>> {
        let strands = match self.ends {
            // Plain arrays may hold what no renderer would draw: roots without hair.
            Ends::Real => Cow::Borrowed(checked(strands)?),
            Ends::Doubled => drawable(strands)?,
        };
        let is_start = self.count(&strands)?;
        if strands.is_empty() {
            return Ok(strands);
        }
        if let (true, Some(extent)) = (self.wants_extents, self.extents.last_mut()) {
            extent.join(&Bounds::of(&strands));
        }
        if is_start {
            let most = self.at_most();
            let columns = self.columns_of_frame();
            let mut present: Vec<_> = columns.filter(|c| c.is_in(&strands)).collect();
            place(&mut present, most);
        }
        let mut scratch = std::mem::take(&mut self.scratch);
        let ends = self.ends;
        for column in self.columns_of_frame() {
            column.take(&strands, ends, &mut scratch)?;
        }
        self.scratch = scratch;
        Ok(strands)
    }

    /// Counts `strands`; whether they are the first of their frame. They must not
    /// be more than can come: they would run into the place of another array.
    fn count(&mut self, strands: &StrandBuffer) -> io::Result<bool> {
        let most = self.at_most();
        let Some(now) = &mut self.now else {
            return Err(refused("strands came outside a frame"));
        };
        let is_start = now.amount == Amount::default();
        for strand in 0..strands.len() {
            now.add(self.ends.count(strands.vertex_count(strand)));
        }
        let (now, most) = (*now, most.unwrap_or(now.amount));
        if now.amount.strands <= most.strands && now.amount.vertices <= most.vertices {
            return Ok(is_start);
        }
        Err(match self.first {
            Some(first) => self.changed(now, first),
            None => refused(format!(
                "{} strands of {} vertices came; {} of {} at the most were announced",
                now.amount.strands, now.amount.vertices, most.strands, most.vertices
            )),
        })
    }

    /// What the frame brings at the most, as written: what the first one brought, or
    /// what was announced of it.
    fn at_most(&self) -> Option<Amount> {
        match self.first {
            Some(first) => Some(first.amount),
            None => self.info.at_most.map(|most| self.ends.amount(most)),
        }
    }

    /// The columns that the frame fills: all in the first, then those that move.
    pub(crate) fn columns_of_frame(&mut self) -> impl Iterator<Item = &mut Column> {
        let is_first = self.frames == 1;
        let columns = self.columns.iter_mut();
        columns.filter(move |column| is_first || column.field.moves())
    }

    /// Closes the frame: its counts, which must be those of the first frame.
    pub(crate) fn end_frame(&mut self) -> io::Result<Tally> {
        let Some(now) = self.now.take() else {
            return Err(refused("a frame ended that had not begun"));
        };
        let first = *self.first.get_or_insert(now);
        if now != first {
            return Err(self.changed(now, first));
        }
        Ok(now)
    }

    fn changed(&self, now: Tally, first: Tally) -> io::Error {
        refused(format!(
            "frame {} has {} curves of {} vertices, the first frame {} of {}: \
             counts must not change between frames",
            self.frames,
            now.amount.strands,
            now.amount.vertices,
            first.amount.strands,
            first.amount.vertices
        ))
    }

    fn expected_frames(&self) -> usize {
        self.info.frames.len().max(1)
    }

    /// Ends the stream; fails where frames are missing.
    pub(crate) fn finish(self) -> io::Result<Recorded> {
        let expected = self.expected_frames();
        let tally = match self.first {
            Some(tally) if self.now.is_none() && self.frames == expected => tally,
            _ => {
                return Err(refused(format!(
                    "the stream ended in frame {} of {expected}",
                    self.frames
                )));
            }
        };
        Ok(Recorded {
            info: self.info,
            tally,
            columns: self.columns,
            extents: self.extents,
        })
    }
}

/// A stream that has ended.
#[derive(Debug)]
pub(crate) struct Recorded {
    pub(crate) info: StreamInfo,
    pub(crate) tally: Tally,
    pub(crate) columns: Vec<Column>,
    /// One box a frame; empty boxes unless extents were asked for.
    pub(crate) extents: Vec<Bounds>,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strands(offsets: &[u32]) -> StrandBuffer {
        StrandBuffer {
            offsets: offsets.to_vec(),
            points: vec![[0.0; 3]; offsets[offsets.len() - 1] as usize],
            ..Default::default()
        }
    }

    fn recorder(frames: &[f64]) -> io::Result<Recorder> {
        let info = StreamInfo {
            frames: frames.to_vec(),
            ..Default::default()
        };
        Recorder::new(&info, Ends::Doubled, Vec::new())
    }

    #[test]
    fn frames_must_bring_the_same_vertex_counts_in_the_same_order() {
        let mut recorder = recorder(&[1.0, 2.0]).unwrap();
        recorder.begin_frame().unwrap();
        recorder.take(&strands(&[0, 2, 5]), |_, _| ()).unwrap();
        assert_eq!(recorder.end_frame().unwrap().amount.vertices, 9);
        recorder.begin_frame().unwrap();
        recorder.take(&strands(&[0, 3, 5]), |_, _| ()).unwrap();
        let error = recorder.end_frame().unwrap_err().to_string();
        assert!(error.contains("must not change"), "{error}");
    }

    #[test]
    fn a_stream_must_bring_the_frames_it_announced() {
        assert!(recorder(&[2.0, 1.0]).is_err());
        assert!(recorder(&[f64::NAN]).is_err());
        let mut early = recorder(&[1.0, 2.0]).unwrap();
        early.begin_frame().unwrap();
        early.end_frame().unwrap();
        let error = early.finish().unwrap_err().to_string();
        assert_eq!(error, "the stream ended in frame 1 of 2");
        let mut late = recorder(&[]).unwrap();
        late.begin_frame().unwrap();
        late.end_frame().unwrap();
        assert!(late.begin_frame().is_err());
    }

    #[test]
    fn strands_outside_a_frame_are_refused() {
        let mut recorder = recorder(&[]).unwrap();
        assert!(recorder.take(&strands(&[0, 2]), |_, _| ()).is_err());
        assert!(recorder.end_frame().is_err());
    }
}
