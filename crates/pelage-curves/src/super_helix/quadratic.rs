//! What the samples after a place cost, as a quadratic of how the place moves.
//!
//! A place moves by six numbers, its shift and its spin. Over an element they become ten
//! with the element's own four. Walked from the tip to the root, what comes after counts
//! either as one rigid body (its inertia, from which the diagonal blocks of the normal
//! matrix come) or as a body that answers ([`sweep`](super::sweep)).

use super::linear::{Block, Linear, Link, Row};
use glam::{DMat3, DVec3};

/// Order of the ten: shift, spin, (q0, q1, q2), joint.
pub(super) const ALL: usize = 10;

/// Hessian, of which the upper triangle counts, and gradient.
#[derive(Clone, Copy, Debug)]
pub(super) struct Quadratic<const N: usize> {
    pub hessian: [[f64; N]; N],
    pub gradient: [f64; N],
}

impl<const N: usize> Quadratic<N> {
    pub const ZERO: Self = Self {
        hessian: [[0.0; N]; N],
        gradient: [0.0; N],
    };
}

/// The diagonal blocks of JᵀJ, one a block of unknowns, and what each element's own rows
/// cost, for solvers to use again at another damping.
#[derive(Clone, Debug)]
pub(super) struct Blocks {
    pub own: Vec<Quadratic<ALL>>,
    pub diagonal: Vec<[Block; 4]>,
}

impl Blocks {
    pub fn new(linear: &Linear) -> Self {
        let count = linear.links.len();
        let own: Vec<_> = (0..count).map(|i| of_rows(linear.rows_of(i))).collect();
        let mut diagonal = vec![[[0.0; 4]; 4]; count + 1];
        let mut after = Quadratic::<6>::ZERO;
        for (i, link) in linear.links.iter().enumerate().rev() {
            let all = over(link, &after, &own[i]);
            diagonal[i + 1] = std::array::from_fn(|a| {
                std::array::from_fn(|b| all.hessian[6 + a.min(b)][6 + a.max(b)])
            });
            after = before(&all);
        }
        if linear.root {
            diagonal[0] = std::array::from_fn(|a| {
                std::array::from_fn(|b| match a < 3 && b < 3 {
                    true => after.hessian[3 + a.min(b)][3 + a.max(b)],
                    false => 0.0,
                })
            });
        }
        Self { own, diagonal }
    }
}

/// An element's cost where its own four do not move.
fn before(all: &Quadratic<ALL>) -> Quadratic<6> {
    Quadratic {
        hessian: std::array::from_fn(|a| std::array::from_fn(|b| all.hessian[a][b])),
        gradient: std::array::from_fn(|a| all.gradient[a]),
    }
}

/// Half the sum of squares of an element's own rows.
fn of_rows(rows: &[Row]) -> Quadratic<ALL> {
    let mut sum = Sums::ZERO;
    for row in rows {
        sum.add(row);
    }
    sum.quadratic()
}

/// Sums over rows, each of which is [mass, -[arm]×, block, 0] times the ten plus a residual.
struct Sums {
    mass: f64,
    moment: DVec3,
    /// Σ arm armᵀ.
    inertia: DMat3,
    /// Σ mass block, Σ arm × block and Σ blockᵀ block, by columns.
    pull: DMat3,
    torque: DMat3,
    square: DMat3,
    /// The same three of the residual.
    force: DVec3,
    turn: DVec3,
    own: DVec3,
}

impl Sums {
    const ZERO: Self = Self {
        mass: 0.0,
        moment: DVec3::ZERO,
        inertia: DMat3::ZERO,
        pull: DMat3::ZERO,
        torque: DMat3::ZERO,
        square: DMat3::ZERO,
        force: DVec3::ZERO,
        turn: DVec3::ZERO,
        own: DVec3::ZERO,
    };

    #[inline(always)]
    fn add(&mut self, row: &Row) {
        let Row {
            mass,
            arm,
            block,
            residual,
        } = *row;
        self.mass += mass * mass;
        self.moment += arm * mass;
        self.inertia += DMat3::from_cols(arm * arm.x, arm * arm.y, arm * arm.z);
        self.pull += block * mass;
        let cross = |k: usize| arm.cross(block.col(k));
        self.torque += DMat3::from_cols(cross(0), cross(1), cross(2));
        let transposed = block.transpose();
        self.square += transposed * block;
        self.force += residual * mass;
        self.turn += arm.cross(residual);
        self.own += transposed * residual;
    }

    fn quadratic(&self) -> Quadratic<ALL> {
        let mut sum = Quadratic::<ALL>::ZERO;
        let m = self.moment;
        // -Σ mass [arm]× and Σ |arm|² - arm armᵀ.
        let skew = DMat3::from_cols_array(&[0.0, -m.z, m.y, m.z, 0.0, -m.x, -m.y, m.x, 0.0]);
        let i = self.inertia;
        let trace = i.x_axis.x + i.y_axis.y + i.z_axis.z;
        let round = DMat3::from_diagonal(DVec3::splat(trace)) - i;
        let flat = DMat3::from_diagonal(DVec3::splat(self.mass));
        for (a, b, part) in [
            (0, 0, flat),
            (0, 3, skew),
            (0, 6, self.pull),
            (3, 3, round),
            (3, 6, self.torque),
            (6, 6, self.square),
        ] {
            for (row, line) in part.transpose().to_cols_array_2d().iter().enumerate() {
                sum.hessian[a + row][b..b + 3].copy_from_slice(line);
            }
        }
        sum.gradient[..3].copy_from_slice(&self.force.to_array());
        sum.gradient[3..6].copy_from_slice(&self.turn.to_array());
        sum.gradient[6..9].copy_from_slice(&self.own.to_array());
        sum
    }
}

/// What an element's own rows and all after it cost, as `after` tells of its end.
pub(super) fn over(link: &Link, after: &Quadratic<6>, own: &Quadratic<ALL>) -> Quadratic<ALL> {
    let map = transfer(link);
    let mut pushed = [[0.0; ALL]; 6];
    for (a, line) in pushed.iter_mut().enumerate() {
        for (b, moved) in map.iter().enumerate() {
            let h = after.hessian[a.min(b)][a.max(b)];
            line.iter_mut().zip(moved).for_each(|(p, m)| *p += h * m);
        }
    }
    let mut sum = *own;
    for ((moved, line), g) in map.iter().zip(&pushed).zip(&after.gradient) {
        let rows = sum.hessian.iter_mut().zip(&mut sum.gradient);
        for ((row, slope), m) in rows.zip(moved) {
            row.iter_mut().zip(line).for_each(|(x, p)| *x += m * p);
            *slope += m * g;
        }
    }
    sum
}

/// How the end moves with the ten.
fn transfer(link: &Link) -> [[f64; ALL]; 6] {
    let (d, jump) = (link.chord, link.jump.to_array());
    let shift = link.shift.transpose().to_cols_array_2d();
    let spin = link.spin.transpose().to_cols_array_2d();
    let turn = [[0.0, d.z, -d.y], [-d.z, 0.0, d.x], [d.y, -d.x, 0.0]];
    let mut map = [[0.0; ALL]; 6];
    for k in 0..3 {
        map[k][k] = 1.0;
        map[3 + k][3 + k] = 1.0;
        map[k][3..6].copy_from_slice(&turn[k]);
        map[k][6..9].copy_from_slice(&shift[k]);
        map[3 + k][6..9].copy_from_slice(&spin[k]);
        map[3 + k][9] = jump[k];
    }
    map
}

/// Square root of a symmetric, positive matrix of four; `None` where it is not positive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cholesky([Block; 4]);

impl Cholesky {
    pub fn new(matrix: &[Block; 4]) -> Option<Self> {
        let mut l = [[0.0; 4]; 4];
        for i in 0..4 {
            for j in 0..=i {
                let dot: f64 = (0..j).map(|k| l[i][k] * l[j][k]).sum();
                let rest = matrix[i.min(j)][i.max(j)] - dot;
                if i == j && !(rest > 0.0 && rest.is_finite()) {
                    return None;
                }
                l[i][j] = if i == j { rest.sqrt() } else { rest / l[j][j] };
            }
        }
        Some(Self(l))
    }

    /// The solution for the right-hand side `b`.
    pub fn solve(&self, mut b: Block) -> Block {
        let l = &self.0;
        for i in 0..4 {
            for k in 0..i {
                b[i] -= l[i][k] * b[k];
            }
            b[i] /= l[i][i];
        }
        for i in (0..4).rev() {
            for k in i + 1..4 {
                b[i] -= l[k][i] * b[k];
            }
            b[i] /= l[i][i];
        }
        b
    }
}
