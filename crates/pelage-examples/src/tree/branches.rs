//! How the tree branches.
//!
//! A branch goes on in small steps that wander, and turn up to the light; those of the next
//! level leave it around the golden angle, so that none stands above another, and are the
//! longer the lower they leave. All of it is a function of a branch's number.

use crate::hash::unit;
use glam::DVec3;

/// Trunk, boughs, branches and twigs.
pub const LEVELS: usize = 4;

/// A branch as a curve with a radius at each vertex; metres, y up.
pub struct Branch {
    pub level: usize,
    pub points: Vec<DVec3>,
    pub radii: Vec<f64>,
}

/// How the branches of a level grow.
struct Habit {
    /// Steps of a branch.
    steps: usize,
    /// Branches that leave it.
    children: usize,
    /// Part of its length below the first of these.
    bare: f64,
    /// Their length over its own, and their radius over its own where they leave.
    length: f64,
    radius: f64,
    /// Angle at which they leave it.
    angle: f64,
    /// How far a step wanders, and how far it turns up.
    wander: f64,
    up: f64,
}

const HABITS: [Habit; LEVELS] = [
    Habit {
        steps: 16,
        children: 18,
        bare: 0.28,
        length: 0.62,
        radius: 0.62,
        angle: 1.05,
        wander: 0.09,
        up: 0.05,
    },
    Habit {
        steps: 12,
        children: 9,
        bare: 0.2,
        length: 0.5,
        radius: 0.6,
        angle: 0.85,
        wander: 0.14,
        up: 0.07,
    },
    Habit {
        steps: 8,
        children: 6,
        bare: 0.15,
        length: 0.5,
        radius: 0.65,
        angle: 0.8,
        wander: 0.16,
        up: 0.04,
    },
    Habit {
        steps: 5,
        children: 0,
        bare: 0.0,
        length: 0.0,
        radius: 0.0,
        angle: 0.0,
        wander: 0.15,
        up: 0.03,
    },
];

/// 137.5 degrees.
const GOLDEN_ANGLE: f64 = 2.399_963_229_728_653;

/// Height and radius of the trunk.
const HEIGHT: f64 = 4.2;
const RADIUS: f64 = 0.15;

/// All branches, each after the one it leaves.
pub fn grow() -> Vec<Branch> {
    let mut all = vec![branch(0, 0, DVec3::ZERO, DVec3::Y, [HEIGHT, RADIUS])];
    let mut next = 0;
    while next < all.len() {
        for child in 0..HABITS[all[next].level].children {
            let grown = leave(&all[next], child, all.len() as u64);
            all.push(grown);
        }
        next += 1;
    }
    all
}

/// A number in -1..1.
fn signed(channel: u64, index: u64) -> f64 {
    2.0 * unit(channel, index) - 1.0
}

/// Branch `number`, which is child `child` of `parent`.
fn leave(parent: &Branch, child: usize, number: u64) -> Branch {
    let habit = &HABITS[parent.level];
    let order = (child as f64 + 0.5 + 0.3 * signed(81, number)) / habit.children as f64;
    let place = (habit.bare + (0.97 - habit.bare) * order) * habit.steps as f64;
    let at = (place as usize).min(habit.steps - 1);
    let part = place - at as f64;
    let (a, b) = (parent.points[at], parent.points[at + 1]);
    let along = (b - a).normalize();
    let aside = along.any_orthonormal_vector();
    let turn = GOLDEN_ANGLE * (child as f64 + number as f64 * 0.37) + 0.4 * signed(82, number);
    let out = aside * libm::cos(turn) + along.cross(aside) * libm::sin(turn);
    // The lower a branch, the more it stands off.
    let angle = habit.angle * (1.15 - 0.35 * order) + 0.15 * signed(83, number);
    let direction = along * libm::cos(angle) + out * libm::sin(angle);
    let whole = (habit.steps as f64) * a.distance(b);
    let taper = 1.0 - 0.72 * order;
    let length = whole * habit.length * taper * (1.0 + 0.2 * signed(84, number));
    let here = parent.radii[at] + (parent.radii[at + 1] - parent.radii[at]) * part;
    branch(
        parent.level + 1,
        number,
        a.lerp(b, part),
        direction,
        [length, here * habit.radius],
    )
}

fn branch(
    level: usize,
    number: u64,
    start: DVec3,
    direction: DVec3,
    [length, radius]: [f64; 2],
) -> Branch {
    let habit = &HABITS[level];
    let (mut points, mut radii) = (vec![start], vec![radius]);
    let mut direction = direction.normalize();
    for step in 0..habit.steps {
        let key = number * 64 + step as u64;
        let wander = DVec3::new(signed(85, key), signed(86, key), signed(87, key));
        direction = (direction + wander * habit.wander + DVec3::Y * habit.up).normalize();
        let before = points[step];
        points.push(before + direction * (length / habit.steps as f64));
        let t = (step + 1) as f64 / habit.steps as f64;
        radii.push(radius * (1.0 - 0.85 * t).max(0.12));
    }
    if level == 0 {
        // The trunk spreads where it leaves the ground.
        radii[0] *= 1.5;
        radii[1] *= 1.1;
    }
    Branch {
        level,
        points,
        radii,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn branches_start_inside_those_they_leave_and_are_thinner() {
        let all = grow();
        assert_eq!(all.len(), 1 + 18 + 18 * 9 + 18 * 9 * 6);
        for level in 1..LEVELS {
            for branch in all.iter().filter(|b| b.level == level) {
                let inside = |parent: &&Branch| {
                    let pairs = parent.points.windows(2);
                    parent.level + 1 == level
                        && parent.radii[0] > branch.radii[0]
                        && pairs.clone().any(|p| {
                            let around =
                                p[0].distance(branch.points[0]) + p[1].distance(branch.points[0]);
                            around < p[0].distance(p[1]) + 1e-9
                        })
                };
                assert!(all.iter().any(|b| inside(&b)));
            }
        }
    }

    #[test]
    fn the_tree_stands_on_the_ground() {
        let all = grow();
        let lowest = all[1..].iter().flat_map(|b| &b.points).map(|p| p.y);
        assert!(lowest.fold(f64::INFINITY, f64::min) > 0.2);
    }
}
