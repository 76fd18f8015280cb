//! Natural neighbours: Sibson's weights on a surface.
//!
//! Source: document 004, section 2.2.4: a guide weighs the part of the root's Voronoi
//! cell that was the guide's before the root came. The domain is that of Boissonnat and
//! Flötotto ("A coordinate system associated with points scattered on a surface", 2004):
//! the plane tangent at the root, cut through the Voronoi diagram of the guides in space.
//! With a guide at y on the plane and h above it, the power |p - y|² + h² takes the place
//! of the squared distance; the root has y = h = 0. Guides that lie far off the plane,
//! such as those of the far side of a body, have no cell on it. On a flat sheet these are
//! Sibson's weights: they give linear functions back, Σ w_k x_k = x.
//!
//! Cells end at a regular polygon around the root, the domain. Inside the convex hull of
//! the guides they hardly reach it. Outside they would have no end; there the weights
//! are those of the guides along the hull's near edge, and change without a jump.
//!
//! Plane coordinates (tangent, binormal) and heights in the unit of the mesh, in f64:
//! areas are differences. Limits: where the surface bends much within a guide's width,
//! linear functions come back nearly only.

use super::weights::{first_alone, normalise};
use pelage_curves::Vec3;
use pelage_curves::glam::{DVec2, DVec3};
use pelage_surface::RootFrame;
use std::f64::consts::TAU;

/// Radius of the domain in distances to the [`ORDER`]th nearest guide, which change
/// without a jump: some five times the distance between guides. Cells inside the hull
/// hardly ever reach it, and hairs outside need not look at every guide there is.
pub const DOMAIN: f64 = 2.0;

/// Which of the nearest guides measures the domain; the last if there are fewer.
pub const ORDER: usize = 24;

/// Corners of the domain. So many that the way it is turned does not show in a hair.
const CORNERS: usize = 24;

/// A guide on the tangent plane of a root.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// Index of the guide in its group.
    pub guide: u32,
    /// Its place on the plane.
    pub at: DVec2,
    /// Its power at the root: the squared distance in space, or D² where it must face
    /// the root (see [`facing`](super::facing)).
    pub power: f64,
    /// Distance to the root in space.
    pub distance: f64,
}

impl Site {
    /// Guide `guide` with its root at `position`, seen from `root` and receding by the
    /// factor `recede`; `None` where that is infinite.
    #[inline]
    pub fn new(guide: u32, position: Vec3, root: &RootFrame, recede: f32) -> Option<Self> {
        let offset: DVec3 = position.as_dvec3() - root.position.as_dvec3();
        let on = |axis: Vec3| offset.dot(axis.as_dvec3());
        let (at, height) = (
            DVec2::new(on(root.tangent), on(root.binormal)),
            on(root.normal),
        );
        let square = at.length_squared() + height * height;
        let power = square * recede as f64;
        power.is_finite().then_some(Self {
            guide,
            at,
            power,
            distance: square.sqrt(),
        })
    }
}

/// A root's cell. Reused between hairs.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The domain of radius 1.
    circle: Vec<DVec2>,
    /// Corners of the convex cell, in turn.
    corners: Vec<DVec2>,
    part: Vec<DVec2>,
    spare: Vec<DVec2>,
}

impl Default for Cell {
    fn default() -> Self {
        let corner = |i: usize| {
            let angle = TAU * i as f64 / CORNERS as f64;
            DVec2::new(libm::cos(angle), libm::sin(angle))
        };
        Self {
            circle: (0..CORNERS).map(corner).collect(),
            corners: Vec::new(),
            part: Vec::new(),
            spare: Vec::new(),
        }
    }
}

impl Cell {
    /// Makes the cell of the root among `sites` (nearest first) in a domain of radius
    /// `domain`. Gives the distance beyond which no guide, whether among `sites` or not,
    /// changes the cell or has a part of it.
    pub fn make(&mut self, sites: &[Site], domain: f64) -> f64 {
        let Self {
            circle,
            corners,
            spare,
            ..
        } = self;
        corners.clear();
        corners.extend(circle.iter().map(|c| *c * domain));
        let (mut radius, mut least) = (domain, f64::INFINITY);
        for site in sites {
            least = least.min(site.power);
            // Half its distance from the root, or farther, lies what it cuts off.
            let reaches = site.distance <= 2.0 * radius;
            if reaches && clip(corners, spare, 2.0 * site.at, site.power) {
                let squares = corners.iter().map(|c| c.length_squared());
                radius = squares.fold(0.0, f64::max).sqrt();
            }
        }
        // In the cell some site has a power below (√least + radius)², one at distance d
        // none below (d - radius)².
        least.sqrt() + 2.0 * radius
    }

    /// Writes each site's share of the cell to `weights`: areas over their sum. Needs
    /// [`make`](Self::make) with the same sites.
    pub fn share(&mut self, sites: &[Site], weights: &mut Vec<f32>) {
        let whole = area(&self.corners);
        weights.clear();
        weights.resize(sites.len(), 1.0);
        // Farthest first: most of them have no part, and need not be asked again.
        for k in (0..sites.len()).rev() {
            weights[k] = (self.part(sites, k, weights) / whole) as f32;
        }
        if !normalise(weights) {
            // A cell too small or too large for numbers.
            first_alone(weights);
        }
    }

    /// Area of the cell where site `k` has the least power; a tie goes to the first. Sites
    /// whose weight is known to be 0 are nowhere least and are passed over.
    fn part(&mut self, sites: &[Site], k: usize, weights: &[f32]) -> f64 {
        let Self {
            corners,
            part,
            spare,
            ..
        } = self;
        part.clone_from(corners);
        let mine = sites[k];
        for (j, other) in sites.iter().enumerate() {
            if j == k || weights[j] == 0.0 {
                continue;
            }
            let (across, offset) = (other.at - mine.at, other.power - mine.power);
            if j < k && across == DVec2::ZERO && offset == 0.0 {
                return 0.0;
            }
            clip(part, spare, 2.0 * across, offset);
            if part.len() < 3 {
                return 0.0;
            }
        }
        area(part)
    }
}

/// Cuts off the part of a convex polygon where `normal · p > offset`; tells whether there
/// was one.
#[inline]
fn clip(polygon: &mut Vec<DVec2>, spare: &mut Vec<DVec2>, normal: DVec2, offset: f64) -> bool {
    let beyond = |p: DVec2| normal.dot(p) - offset;
    if polygon.iter().all(|&p| beyond(p) <= 0.0) {
        return false;
    }
    spare.clear();
    let mut before = polygon.last().copied().unwrap_or_default();
    let mut out_before = beyond(before);
    for &p in polygon.iter() {
        let out = beyond(p);
        if (out_before > 0.0) != (out > 0.0) {
            spare.push(before + (p - before) * (out_before / (out_before - out)));
        }
        if out <= 0.0 {
            spare.push(p);
        }
        (before, out_before) = (p, out);
    }
    std::mem::swap(polygon, spare);
    true
}

/// Area of a convex polygon; corners in either turn.
fn area(polygon: &[DVec2]) -> f64 {
    let Some(&first) = polygon.first() else {
        return 0.0;
    };
    let fan = polygon
        .windows(2)
        .map(|w| (w[0] - first).perp_dot(w[1] - first));
    fan.sum::<f64>().abs() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn weights(sites: &[Site]) -> Vec<f32> {
        let (mut cell, mut weights) = (Cell::default(), Vec::new());
        cell.make(sites, 1e3);
        cell.share(sites, &mut weights);
        weights
    }

    /// Sites at offsets from the root, nearest first.
    fn sites(offsets: &[[f64; 3]]) -> Vec<Site> {
        let frame = RootFrame::new(Vec3::ZERO, Vec3::X, Vec3::Z);
        let mut sites: Vec<Site> = offsets
            .iter()
            .enumerate()
            .filter_map(|(i, o)| Site::new(i as u32, DVec3::from(*o).as_vec3(), &frame, 1.0))
            .collect();
        sites.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        sites
    }

    #[test]
    fn the_corners_of_a_square_share_its_middle() {
        let around = [[1., 0., 0.], [0., 1., 0.], [-1., 0., 0.], [0., -1., 0.]];
        for w in weights(&sites(&around)) {
            assert!((w - 0.25).abs() < 1e-6, "{w}");
        }
    }

    #[test]
    fn guides_that_lie_far_off_the_plane_have_no_part() {
        let near = [[1., 0., 0.], [-1., 1., 0.], [-1., -1., 0.]];
        let body = [near.to_vec(), vec![[0.1, 0.2, -3.0], [0.3, -0.1, -3.0]]].concat();
        let all = sites(&body);
        for (site, w) in all.iter().zip(weights(&all)) {
            assert_eq!(w > 0.0, site.guide < 3, "{site:?} {w}");
        }
    }

    #[test]
    fn of_guides_at_one_place_the_first_counts() {
        let twice = [[1., 0., 0.], [1., 0., 0.], [-1., 1., 0.], [-1., -1., 0.]];
        let found = weights(&sites(&twice));
        assert!(found[0] > 0.2 && found[1] == 0.0, "{found:?}");
    }

    proptest! {
        #[test]
        fn linear_functions_come_back_inside_the_hull_of_a_flat_sheet(
            around in prop::collection::vec((-1.0f64..1.0, -1.0f64..1.0), 0..40),
        ) {
            // A square around the root, so that it lies in the hull.
            let hull = [(-1.5, -1.5), (1.5, -1.5), (1.5, 1.5), (-1.5, 1.5)];
            let offsets: Vec<[f64; 3]> =
                around.iter().chain(&hull).map(|&(x, y)| [x, y, 0.0]).collect();
            let all = sites(&offsets);
            let found = weights(&all);
            let sum: f32 = found.iter().sum();
            prop_assert!((sum - 1.0).abs() < 1e-5);
            let mean: DVec2 = all.iter().zip(&found).map(|(s, &w)| s.at * w as f64).sum();
            prop_assert!(mean.length() < 1e-5, "{mean}");
        }

        #[test]
        fn guides_farther_than_told_change_no_weight(
            around in prop::collection::vec(prop::array::uniform3(-1.0f64..1.0), 1..60),
        ) {
            let flat: Vec<[f64; 3]> = around.iter().map(|&[x, y, z]| [x, y, z * 0.2]).collect();
            let all = sites(&flat);
            let (mut cell, mut some) = (Cell::default(), Vec::new());
            let reach = cell.make(&all, 0.5);
            cell.share(&all, &mut some);
            let near: Vec<Site> = all.iter().copied().filter(|s| s.distance <= reach).collect();
            let mut fewer = Vec::new();
            prop_assert_eq!(cell.make(&near, 0.5), reach);
            cell.share(&near, &mut fewer);
            prop_assert!(some[near.len()..].iter().all(|w| *w == 0.0));
            prop_assert_eq!(&some[..near.len()], &fewer[..]);
        }

        #[test]
        fn weights_are_a_share_whatever_comes(
            around in prop::collection::vec(prop::array::uniform3(-1e18f64..1e18), 1..20),
            scale in prop_oneof![Just(1.0), Just(1e-18), Just(1e-36), Just(1e-60)],
        ) {
            let offsets: Vec<[f64; 3]> = around.iter().map(|o| o.map(|x| x * scale)).collect();
            let found = weights(&sites(&offsets));
            prop_assert!((found.iter().sum::<f32>() - 1.0).abs() < 1e-5, "{found:?}");
            prop_assert!(found.iter().all(|w| (0.0..=1.0).contains(w)));
        }
    }
}
