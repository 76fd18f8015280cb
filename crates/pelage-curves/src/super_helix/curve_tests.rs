use super::*;
use crate::frenet::{Segment, Step};
use proptest::prelude::*;

fn elements(most: usize, rate: f64) -> impl Strategy<Value = Vec<Element>> {
    let element = (0.05f64..1.0, prop::array::uniform3(-rate..rate));
    let element = element.prop_map(|(length, q)| Element::new(length, DVec3::from(q)));
    prop::collection::vec(element, 1..most)
}

fn curve(elements: &[Element]) -> SuperHelix {
    SuperHelix::new(DVec3::ONE, Frame::IDENTITY, elements).unwrap()
}

fn with(elements: &[Element], index: usize, axis: usize, change: f64) -> SuperHelix {
    let mut elements = elements.to_vec();
    let mut rate = elements[index].rate();
    rate[axis] += change;
    elements[index] = Element::new(elements[index].length, rate);
    curve(&elements)
}

fn vectors(place: Place) -> [DVec3; 3] {
    let Frame {
        tangent,
        normal,
        binormal,
    } = place.frame;
    [tangent, normal, binormal]
}

proptest! {
    #[test]
    fn derivatives_are_the_limits_of_differences(
        elements in elements(6, 8.0), at in 0.0f64..1.0, small in prop::bool::ANY,
    ) {
        let elements: Vec<Element> = match small {
            true => elements.iter().map(|e| Element::new(e.length, e.rate() * 1e-7)).collect(),
            false => elements,
        };
        let whole = curve(&elements);
        let s = at * whole.length();
        let found = whole.derivatives(s);
        let h = 1e-5;
        for i in 0..elements.len() {
            let own = found.get(i).copied().unwrap_or_default();
            for k in 0..3 {
                let (plus, minus) = (with(&elements, i, k, h).at(s), with(&elements, i, k, -h).at(s));
                let shift = (plus.position - minus.position) / (2.0 * h);
                prop_assert!(shift.distance(own.shift[k]) < 1e-8, "{} {}", shift, own.shift[k]);
                for v in 0..3 {
                    let turn = (vectors(plus)[v] - vectors(minus)[v]) / (2.0 * h);
                    let foretold = own.spin[k].cross(vectors(whole.at(s))[v]);
                    prop_assert!(turn.distance(foretold) < 1e-8, "{} {}", turn, foretold);
                }
            }
        }
    }

    #[test]
    fn an_element_cut_in_two_is_the_same_curve_however_much_it_turns(
        rate in prop::array::uniform3(-1.0f64..1.0), exponent in -12.0f64..3.0, cut in 0.0f64..1.0,
    ) {
        let rate = DVec3::from(rate) * libm::pow(10.0, exponent);
        let whole = curve(&[Element::new(1.0, rate)]).at(1.0);
        let parts = [Element::new(cut, rate), Element::new(1.0 - cut, rate)];
        let parts = curve(&parts).at(1.0);
        // An angle of a thousand radians has lost three digits before any sine.
        let slack = 4e-15 * (1.0 + rate.length());
        prop_assert!(whole.position.distance(parts.position) < slack);
        for (v, w) in vectors(whole).into_iter().zip(vectors(parts)) {
            prop_assert!(v.distance(w) < slack, "{} {}", v, w);
        }
    }

    #[test]
    fn one_element_is_the_helix_of_the_frenet_step(
        length in 0.1f64..3.0, curvature in 0.0f64..9.0, torsion in -9.0f64..9.0,
    ) {
        let element = Element { length, twist: torsion, curvatures: [0.0, curvature] };
        let end = SuperHelix::new(DVec3::ZERO, Frame::IDENTITY, &[element]).unwrap().at(length);
        let step = Step::new(Segment { length, curvature, torsion });
        prop_assert!(end.position.distance(step.shift(&Frame::IDENTITY)) < 1e-13);
        prop_assert!(end.frame.tangent.distance(step.frame(&Frame::IDENTITY).tangent) < 1e-13);
    }

    #[test]
    fn frames_stay_orthonormal_and_tangents_are_the_derivative(elements in elements(40, 30.0)) {
        let whole = curve(&elements);
        for piece in 0..elements.len() {
            let [_, first, second] = SpaceCurve::at(&whole, piece, 0.5);
            let h = 1e-5;
            let near = |t: f64| SpaceCurve::at(&whole, piece, t);
            let slope = (near(0.5 + h)[0] - near(0.5 - h)[0]) / (2.0 * h);
            prop_assert!(slope.distance(first) < 1e-6);
            let bend = (near(0.5 + h)[1] - near(0.5 - h)[1]) / (2.0 * h);
            prop_assert!(bend.distance(second) < 1e-4);
        }
        let [t, n, b] = vectors(whole.at(whole.length()));
        prop_assert!((t.length() - 1.0).abs() < 1e-13 && t.dot(n).abs() < 1e-13);
        prop_assert!(t.cross(n).distance(b) < 1e-13);
    }
}

#[test]
fn numbers_that_are_no_curve_are_refused_and_named() {
    let new = |e: &[Element]| SuperHelix::new(DVec3::ZERO, Frame::IDENTITY, e);
    let good = Element::new(1.0, DVec3::ONE);
    assert_eq!(new(&[]), Err(FitError::NoElements));
    for bad in [
        Element::new(-1.0, DVec3::ONE),
        Element::new(f64::NAN, DVec3::ONE),
        Element::new(1.0, DVec3::splat(f64::INFINITY)),
        Element::new(1e6, DVec3::splat(1e7)),
    ] {
        assert_eq!(new(&[good, bad]), Err(FitError::Element { index: 1 }));
    }
    let nowhere = SuperHelix::new(DVec3::NAN, Frame::IDENTITY, &[good]);
    assert_eq!(nowhere, Err(FitError::Start));
}

#[test]
fn places_before_the_root_and_after_the_tip_are_those() {
    let whole = curve(&[Element::new(1.0, DVec3::ONE), Element::new(0.0, DVec3::ONE)]);
    assert_eq!(whole.at(-1.0), whole.root());
    assert_eq!(whole.at(2.0).position, whole.at(1.0).position);
}
