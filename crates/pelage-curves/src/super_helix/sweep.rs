//! The damped normal equations, solved exactly in one walk up and one down.
//!
//! What comes after an element acts through six numbers only, so they are eliminated
//! element by element from the tip: the least cost of all after a place is a quadratic of
//! how the place moves (the Riccati recursion of a linear-quadratic regulator, with the
//! root as its start and arc length as its time). O(elements) beside the rows' sums.

use super::linear::{Block, Linear};
use super::quadratic::{ALL, Blocks, Cholesky, Quadratic, over};

/// The step that solves (JᵀJ + `damping`) step = -gradient, `damping` a diagonal and the
/// gradient that of `blocks`; `None`
/// where the matrix is not positive to rounding.
pub(super) fn solve(linear: &Linear, blocks: &Blocks, damping: &[Block]) -> Option<Vec<Block>> {
    let mut answers = Vec::with_capacity(linear.links.len());
    let mut after = Quadratic::<6>::ZERO;
    for (i, link) in linear.links.iter().enumerate().rev() {
        let all = over(link, &after, &blocks.own[i]);
        let (answer, before) = eliminate(&all, &damping[i + 1])?;
        answers.push(answer);
        after = before;
    }
    let mut step = vec![[0.0; 4]; linear.links.len() + 1];
    if linear.root {
        step[0] = turn_root(&after, &damping[0])?;
    }
    let mut place = [0.0, 0.0, 0.0, step[0][0], step[0][1], step[0][2]];
    for (i, link) in linear.links.iter().enumerate() {
        let answer = &answers[answers.len() - 1 - i];
        let own = answer.to(&place);
        step[i + 1] = own;
        place = moved(link, &place, &own);
    }
    Some(step)
}

/// How an element's four answer to how its start moves.
struct Answer {
    constant: Block,
    linear: [Block; 6],
}

impl Answer {
    fn to(&self, place: &[f64; 6]) -> Block {
        std::array::from_fn(|k| {
            let sum: f64 = (0..6).map(|a| self.linear[a][k] * place[a]).sum();
            -(self.constant[k] + sum)
        })
    }
}

/// The least cost over an element's own four, and where it is.
fn eliminate(all: &Quadratic<ALL>, damping: &Block) -> Option<(Answer, Quadratic<6>)> {
    let corner: [Block; 4] = std::array::from_fn(|a| {
        std::array::from_fn(|b| {
            let own = if a == b { damping[a] } else { 0.0 };
            all.hessian[6 + a.min(b)][6 + a.max(b)] + own
        })
    });
    let root = Cholesky::new(&corner)?;
    let side = |a: usize| -> Block { std::array::from_fn(|k| all.hessian[a][6 + k]) };
    let answer = Answer {
        constant: root.solve(std::array::from_fn(|k| all.gradient[6 + k])),
        linear: std::array::from_fn(|a| root.solve(side(a))),
    };
    let dot = |x: &Block, y: &Block| (0..4).map(|k| x[k] * y[k]).sum::<f64>();
    let before = Quadratic {
        hessian: std::array::from_fn(|a| {
            let own = side(a);
            std::array::from_fn(|b| all.hessian[a][b] - dot(&own, &answer.linear[b]))
        }),
        gradient: std::array::from_fn(|a| all.gradient[a] - dot(&side(a), &answer.constant)),
    };
    Some((answer, before))
}

fn turn_root(all: &Quadratic<6>, damping: &Block) -> Option<Block> {
    let mut corner = [[0.0; 4]; 4];
    for a in 0..3 {
        corner[a][a..3].copy_from_slice(&all.hessian[3 + a][3 + a..]);
        corner[a][a] += damping[a];
    }
    corner[3][3] = 1.0;
    let gradient = [3, 4, 5].map(|k| -all.gradient[k]);
    let [x, y, z] = gradient;
    Some(Cholesky::new(&corner)?.solve([x, y, z, 0.0]))
}

/// How an element's end moves with its start and its own four.
fn moved(link: &super::linear::Link, place: &[f64; 6], own: &Block) -> [f64; 6] {
    use glam::DVec3;
    let (shift, spin) = (
        DVec3::from_slice(&place[..3]),
        DVec3::from_slice(&place[3..]),
    );
    let rate = DVec3::from_slice(&own[..3]);
    let p = shift + spin.cross(link.chord) + link.shift * rate;
    let t = spin + link.spin * rate + link.jump * own[3];
    [p.x, p.y, p.z, t.x, t.y, t.z]
}
