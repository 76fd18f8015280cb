use super::*;
use crate::super_helix::quadratic::Blocks;
use crate::super_helix::{gradients, sweep};
use proptest::prelude::*;

/// A shape of length 1 and samples of another curve, with all freedoms.
fn problem(rates: &[[f64; 3]], cuts: &[f64], steps: usize) -> (Shape, Samples) {
    let rates: Vec<DVec3> = rates.iter().map(|&r| DVec3::from(r)).collect();
    let total: f64 = cuts[..rates.len()].iter().sum();
    let mut joints = vec![0.0];
    for (i, cut) in cuts[..rates.len()].iter().enumerate() {
        joints.push(joints[i] + cut / total);
    }
    joints[rates.len()] = 1.0;
    let at = |i: usize| i as f64 / steps as f64;
    let points = (0..=steps).map(at);
    let points = points.map(|s| DVec3::new(s, 0.1 * libm::sin(9.0 * s), 0.1 * s * s));
    let tangents = (0..=steps).map(|i| DVec3::new(1.0, at(i), 0.0).normalize());
    let samples = Samples {
        points: points.collect(),
        tangents: tangents.collect(),
        turning: 1.0,
    };
    let root = DMat3::IDENTITY;
    (
        Shape {
            joints,
            rates,
            root,
        },
        samples,
    )
}

const FREE: Freedom = Freedom {
    joints: true,
    root: true,
    orientation: 0.3,
    weights: None,
};

fn problems() -> impl Strategy<Value = (Shape, Samples)> {
    let rates = prop::collection::vec(prop::array::uniform3(-6.0f64..6.0), 1..9);
    let cuts = prop::collection::vec(0.2f64..1.0, 9);
    (rates, cuts, 5usize..60).prop_map(|(rates, cuts, steps)| problem(&rates, &cuts, steps))
}

fn blocks(shape: &Shape) -> impl Strategy<Value = Vec<Block>> + use<> {
    prop::collection::vec(prop::array::uniform4(-1.0f64..1.0), shape.elements() + 1)
}

fn dot(a: &[Block], b: &[Block]) -> f64 {
    a.iter()
        .flatten()
        .zip(b.iter().flatten())
        .map(|(x, y)| x * y)
        .sum()
}

proptest! {
    #[test]
    fn the_model_is_the_limit_of_differences(
        ((shape, samples), step) in problems().prop_flat_map(|p| { let s = blocks(&p.0); (Just(p), s) }),
    ) {
        // A sample's tangent has a kink where a joint passes it.
        let apart = |j: &f64| (j * samples.steps() as f64).fract();
        let inner = &shape.joints[1..shape.elements()];
        prop_assume!(inner.iter().all(|j| (0.001..0.999).contains(&apart(j))));
        let mut step = step;
        step[0][3] = 0.0;
        step[shape.elements()][3] = 0.0;
        let linear = Linear::new(&shape, &samples, &FREE);
        let mut foretold = vec![DVec3::ZERO; linear.rows.len()];
        linear.product(&step, &mut foretold);
        let h = 1e-6;
        let moved = |by: f64| {
            let step: Vec<Block> = step.iter().map(|b| b.map(|x| x * by)).collect();
            Linear::new(&shape.moved(&step), &samples, &FREE)
        };
        let (plus, minus) = (moved(h), moved(-h));
        for (i, foretold) in foretold.iter().enumerate() {
            let slope = (plus.rows[i].residual - minus.rows[i].residual) / (2.0 * h);
            prop_assert!(slope.distance(*foretold) < 2e-5, "row {}: {} {}", i, slope, foretold);
        }
    }

    #[test]
    fn the_transposed_product_is_the_adjoint_of_the_product(
        ((shape, samples), step) in problems().prop_flat_map(|p| { let s = blocks(&p.0); (Just(p), s) }),
    ) {
        let mut step = step;
        step[0][3] = 0.0;
        let linear = Linear::new(&shape, &samples, &FREE);
        let mut product = vec![DVec3::ZERO; linear.rows.len()];
        linear.product(&step, &mut product);
        let force = |i: usize| DVec3::new(1.0, i as f64 * 0.1, -0.5);
        let mut back = step.clone();
        linear.transposed(force, &mut back);
        let there: f64 = product.iter().enumerate().map(|(i, p)| p.dot(force(i))).sum();
        prop_assert!((there - dot(&step, &back)).abs() < 1e-10 * (1.0 + there.abs()));
    }

    #[test]
    fn both_solvers_solve_the_normal_equations((shape, samples) in problems()) {
        let linear = Linear::new(&shape, &samples, &FREE);
        let blocks = Blocks::new(&linear);
        let damping: Vec<Block> = blocks
            .diagonal
            .iter()
            .map(|block| std::array::from_fn(|k| 1e-3 * block[k][k].max(1e-6)))
            .collect();
        let mut slope = vec![[0.0; 4]; damping.len()];
        linear.transposed(|i| linear.rows[i].residual, &mut slope);
        let size = dot(&slope, &slope).sqrt();
        for (name, step) in [
            ("sweep", sweep::solve(&linear, &blocks, &damping).unwrap()),
            ("gradients", gradients::solve(&linear, &blocks, &damping, &slope).unwrap()),
        ] {
            // (JᵀJ + D) step + Jᵀ residual, which is to vanish.
            let mut product = vec![DVec3::ZERO; linear.rows.len()];
            linear.product(&step, &mut product);
            let mut left = slope.clone();
            linear.transposed(|i| product[i] + linear.rows[i].residual, &mut left);
            for ((l, d), x) in left.iter_mut().zip(&damping).zip(&step) {
                (0..4).for_each(|k| l[k] += d[k] * x[k]);
            }
            let rest = dot(&left, &left).sqrt();
            prop_assert!(rest <= 1e-5 * size, "{}: {} of {}", name, rest, size);
        }
    }

    #[test]
    fn the_blocks_are_those_of_the_normal_matrix((shape, samples) in problems()) {
        let linear = Linear::new(&shape, &samples, &FREE);
        let diagonal = Blocks::new(&linear).diagonal;
        for (i, block) in diagonal.iter().enumerate() {
            let column = |k: usize| {
                let mut unit = vec![[0.0; 4]; diagonal.len()];
                unit[i][k] = 1.0;
                let mut product = vec![DVec3::ZERO; linear.rows.len()];
                linear.product(&unit, &mut product);
                product
            };
            for (a, line) in block.iter().enumerate() {
                for (b, found) in line.iter().enumerate() {
                    // The root has no fourth unknown.
                    let exists = i > 0 || (a < 3 && b < 3);
                    let pairs = column(a).into_iter().zip(column(b));
                    let exact = pairs.map(|(x, y)| x.dot(y)).sum::<f64>() * f64::from(exists);
                    prop_assert!((found - exact).abs() < 1e-11, "{} {}", found, exact);
                }
            }
        }
    }
}
