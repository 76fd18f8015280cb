//! A sky as a light: directions as likely as they are bright, their density, and the way
//! back from a direction to the numbers that lead to it.
//!
//! Source: document 004, section 2.1.6, which names this use of its search. Nothing here
//! is about surfaces: it is [`Distribution`] over the texels, and one texel's geometry.

use pelage::curves::DVec3;
use pelage::surface::{Distribution, ImageMap};
use std::f64::consts::{PI, TAU};

/// The light of an image in latitude and longitude, as if from infinitely far away.
///
/// Up is +y. The image's left border lies towards +x, and columns go round by +z; its
/// upper border is the zenith. Light is constant on each texel, so that directions can be
/// drawn in exact proportion to it.
pub struct Sky {
    width: usize,
    height: usize,
    /// Luminance of each texel, rows from the top.
    luminance: Vec<f64>,
    /// The texels that send light, in the order of the distribution.
    lit: Vec<u32>,
    /// Where each texel stands among them.
    place: Vec<Option<u32>>,
    texels: Distribution,
}

/// Where a direction meets the image.
#[derive(Clone, Copy)]
struct Spot {
    column: usize,
    row: usize,
    /// Fractions of the texel: from left to right, and of its solid angle from bottom to
    /// top.
    inside: [f64; 2],
}

/// Directions keep this fraction of a texel away from its borders, so that rounding never
/// finds them in the next one.
const BORDER: f64 = 1e-7;

impl Sky {
    /// The light of `image`: of its luminance (Rec. 709) where it has three channels or
    /// more, of its first channel otherwise. `None` for a sky that is black all over.
    ///
    /// Texels lie along a Hilbert curve: those that follow each other are neighbours in the
    /// sky, so that numbers that are spread evenly spread their directions evenly.
    pub fn new(image: &ImageMap) -> Option<Self> {
        let side = image.width().max(image.height()).next_power_of_two() as usize;
        Self::ordered(image, |column, row| along_curve(side, column, row))
    }

    /// The same with texels in the order that `rank` gives their column and row.
    pub fn ordered(image: &ImageMap, rank: impl Fn(usize, usize) -> usize) -> Option<Self> {
        let [width, height] = [image.width(), image.height()].map(|n| n as usize);
        let numbers: Vec<f32> = image.texels().iter().collect();
        let texels = numbers.chunks_exact(image.channels() as usize);
        let luminance: Vec<f64> = texels.map(luminance).collect();
        let mut lit: Vec<u32> = (0..luminance.len() as u32)
            .filter(|&texel| luminance[texel as usize] > 0.0)
            .collect();
        lit.sort_by_cached_key(|&texel| rank(texel as usize % width, texel as usize / width));
        let mut place = vec![None; luminance.len()];
        for (k, &texel) in lit.iter().enumerate() {
            place[texel as usize] = Some(k as u32);
        }
        let weight = |&texel: &u32| {
            let row = texel as usize / width;
            luminance[texel as usize] * solid_angle(row, width, height)
        };
        let weights: Vec<f64> = lit.iter().map(weight).collect();
        Some(Self {
            texels: Distribution::new(&weights)?,
            width,
            height,
            luminance,
            lit,
            place,
        })
    }

    /// The direction that the fractions `x` (of 2^64) and `y` (of 2^32) lead to. Numbers
    /// that are evenly spread give directions in proportion to the luminance.
    ///
    /// The first number picks a texel; how far it lies into the texel's share is a number
    /// again, and says where across.
    pub fn sample(&self, x: u64, y: u32) -> DVec3 {
        let pick = self.texels.pick(x);
        let texel = self.lit[pick.index] as usize;
        let inset = |t: f64| BORDER + t * (1.0 - 2.0 * BORDER);
        self.direction(Spot {
            column: texel % self.width,
            row: texel / self.width,
            inside: [inset(pick.rest as f64), inset(y as f64 / TWO_32)],
        })
    }

    /// Probability that [`sample`](Self::sample) leads to `direction` for a unit of solid
    /// angle; its integral over the sphere is 1. `direction` need not be a unit.
    pub fn pdf(&self, direction: DVec3) -> f64 {
        let spot = self.spot(direction);
        let angle = solid_angle(spot.row, self.width, self.height);
        let place = self.place(spot);
        place.map_or(0.0, |place| self.texels.probability(place) / angle)
    }

    /// The numbers that [`sample`](Self::sample) leads to `direction`, to rounding; `None`
    /// where the sky is black, or too dim beside the rest for any number.
    #[cfg_attr(
        not(test),
        expect(dead_code, reason = "for renderers that change paths by their numbers")
    )]
    pub fn inverse(&self, direction: DVec3) -> Option<(u64, u32)> {
        let spot = self.spot(direction);
        let (start, end) = self.texels.share(self.place(spot)?);
        let [across, up] = spot
            .inside
            .map(|t| ((t - BORDER) / (1.0 - 2.0 * BORDER)).clamp(0.0, 1.0));
        let width = end - start as u128;
        let last = width.checked_sub(1)? as u64;
        // The casts saturate: a share may be all of 2^64.
        let inside = ((across * width as f64) as u64).min(last);
        Some((start + inside, (up * TWO_32) as u32))
    }

    /// Luminance that arrives from `direction`.
    pub fn luminance(&self, direction: DVec3) -> f64 {
        self.luminance[self.texel(self.spot(direction))]
    }

    /// The integral of `light` times the luminance over all directions, by the midpoint
    /// rule with `cuts`² points a texel.
    pub fn integral(&self, cuts: usize, light: impl Fn(DVec3) -> f64) -> f64 {
        let middle = |i: usize| (i as f64 + 0.5) / cuts as f64;
        let row = |row: usize| -> f64 {
            let points = (0..self.width * cuts * cuts).map(|i| Spot {
                column: i / (cuts * cuts),
                row,
                inside: [middle(i % cuts), middle(i / cuts % cuts)],
            });
            let sum: f64 = points
                .map(|spot| self.luminance[self.texel(spot)] * light(self.direction(spot)))
                .sum();
            sum * solid_angle(row, self.width, self.height) / (cuts * cuts) as f64
        };
        (0..self.height).map(row).sum()
    }

    fn texel(&self, spot: Spot) -> usize {
        spot.row * self.width + spot.column
    }

    fn place(&self, spot: Spot) -> Option<usize> {
        self.place[self.texel(spot)].map(|place| place as usize)
    }

    fn direction(&self, spot: Spot) -> DVec3 {
        let turns = (spot.column as f64 + spot.inside[0]) / self.width as f64;
        let [top, bottom] = heights(spot.row, self.height);
        let y = bottom + (top - bottom) * spot.inside[1];
        let radius = (1.0 - y * y).max(0.0).sqrt();
        let (sin, cos) = libm::sincos(TAU * turns);
        DVec3::new(radius * cos, y, radius * sin)
    }

    fn spot(&self, direction: DVec3) -> Spot {
        let turns = libm::atan2(direction.z, direction.x) / TAU;
        let across = (turns + (turns < 0.0) as u32 as f64) * self.width as f64;
        let level = libm::hypot(direction.x, direction.z);
        let down = (0.5 - libm::atan2(direction.y, level) / PI) * self.height as f64;
        let column = (across as usize).min(self.width - 1);
        let row = (down as usize).min(self.height - 1);
        let [top, bottom] = heights(row, self.height);
        let y = direction.y / direction.length();
        Spot {
            column,
            row,
            inside: [across - column as f64, (y - bottom) / (top - bottom)],
        }
    }
}

const TWO_32: f64 = 4_294_967_296.0;

fn luminance(texel: &[f32]) -> f64 {
    let light = match texel {
        [red, green, blue, ..] => 0.2126 * red + 0.7152 * green + 0.0722 * blue,
        _ => texel[0],
    };
    light.max(0.0) as f64
}

/// Height of the upper and the lower border of a row on the unit sphere.
fn heights(row: usize, rows: usize) -> [f64; 2] {
    [row, row + 1].map(|r| libm::cos(PI * r as f64 / rows as f64))
}

/// Solid angle of each texel of a row: by Archimedes, the area of a band of the sphere
/// goes with its height.
fn solid_angle(row: usize, columns: usize, rows: usize) -> f64 {
    let [top, bottom] = heights(row, rows);
    TAU / columns as f64 * (top - bottom)
}

/// Position of cell (x, y) along the Hilbert curve that fills `side × side` cells, a power
/// of two.
fn along_curve(side: usize, mut x: usize, mut y: usize) -> usize {
    let mut along = 0;
    let mut half = side / 2;
    while half > 0 {
        let (right, lower) = (x & half != 0, y & half != 0);
        along += half * half * ((3 * right as usize) ^ lower as usize);
        if !lower {
            if right {
                (x, y) = (side - 1 - x, side - 1 - y);
            }
            (x, y) = (y, x);
        }
        half /= 2;
    }
    along
}

#[cfg(test)]
mod tests {
    use super::*;
    use pelage::surface::{RootSequence, Spread, hash};

    /// A sky with everything that goes wrong: black parts, a sun, and a dim rest.
    fn sky() -> Sky {
        let texel = |i: u32| match (i % 48, i / 48) {
            (30, 7) => 1e6,
            (x, y) if (x / 5 + y / 3) % 4 == 0 => 0.0,
            (x, y) => 0.1 + (hash((y << 8 | x) as u64) >> 40) as f32 / (1 << 24) as f32,
        };
        let texels: Vec<f32> = (0..48 * 24).map(texel).collect();
        Sky::new(&ImageMap::new(48, 24, 1, texels, false).unwrap()).unwrap()
    }

    /// The same without its sun, which takes nearly all samples.
    fn overcast() -> Sky {
        let mut texels: Vec<f32> = sky().luminance.iter().map(|&l| l as f32).collect();
        texels[7 * 48 + 30] = 3.0;
        Sky::new(&ImageMap::new(48, 24, 1, texels, false).unwrap()).unwrap()
    }

    /// Cells of 15 degrees, found without the code under test.
    fn cell(direction: DVec3) -> usize {
        let column = (libm::atan2(direction.z, direction.x).rem_euclid(TAU) / TAU * 24.0) as usize;
        let row = (libm::acos(direction.y) / PI * 12.0) as usize;
        row.min(11) * 24 + column.min(23)
    }

    /// Directions at the centres of equal parts of the sphere, and their solid angle.
    fn all_directions() -> (impl Iterator<Item = DVec3>, f64) {
        let (around, up) = (48 * 4, 2000);
        let directions = (0..around * up).map(move |i| {
            let angle = TAU * ((i % around) as f64 + 0.5) / around as f64;
            let y = 2.0 * ((i / around) as f64 + 0.5) / up as f64 - 1.0;
            let radius = (1.0 - y * y).sqrt();
            DVec3::new(radius * libm::cos(angle), y, radius * libm::sin(angle))
        });
        (directions, 4.0 * PI / (around * up) as f64)
    }

    #[test]
    fn the_density_of_directions_integrates_to_one() {
        for sky in [sky(), overcast()] {
            let (directions, each) = all_directions();
            let total: f64 = directions.map(|d| sky.pdf(d) * each).sum();
            // Bands of equal height cut through the rows of the image.
            assert!((total - 1.0).abs() < 5e-3, "{total}");
        }
    }

    #[test]
    fn directions_are_as_frequent_as_their_density_says() {
        let sky = overcast();
        let dice = RootSequence::new(1, Spread::Random);
        let drawn = 200_000;
        let mut found = [0.0; 12 * 24];
        for i in 0..drawn {
            let (x, y) = dice.sample(i);
            found[cell(sky.sample(x, y))] += 1.0;
        }
        let mut expected = [0.0; 12 * 24];
        let (directions, each) = all_directions();
        for direction in directions {
            expected[cell(direction)] += sky.pdf(direction) * each * drawn as f64;
        }
        let chi_square: f64 = found
            .iter()
            .zip(&expected)
            .filter(|(_, e)| **e > 0.0)
            .map(|(f, e)| (f - e) * (f - e) / e)
            .sum();
        // 287 degrees of freedom: 410 has a probability of 1e-6.
        assert!(chi_square < 410.0, "{chi_square}");
        let outside = found
            .iter()
            .zip(&expected)
            .any(|(f, e)| *e == 0.0 && *f > 0.0);
        assert!(!outside);
    }

    #[test]
    fn a_direction_leads_back_to_its_numbers() {
        for sky in [sky(), overcast()] {
            for i in 0..20_000 {
                let (x, y) = (hash(i), hash(!i) as u32);
                let direction = sky.sample(x, y);
                assert!((direction.length() - 1.0).abs() < 1e-12);
                assert!(sky.pdf(direction) > 0.0);
                let (x_again, y_again) = sky.inverse(direction).unwrap();
                let (start, end) = sky.texels.share(sky.texels.pick(x).index);
                // The position inside a share is a float, of 24 bits.
                let width = (end - start as u128) as f64;
                assert!(x.abs_diff(x_again) as f64 <= width * 1.5e-7 + 1.0);
                assert!(y.abs_diff(y_again) < 1 << 6, "{y} {y_again}");
            }
        }
    }

    #[test]
    fn light_on_a_plane_is_that_of_quadrature() {
        let normal = DVec3::new(0.3, 0.8, -0.5).normalize();
        for sky in [sky(), overcast()] {
            let cosine = |d: DVec3| d.dot(normal).max(0.0);
            let truth = sky.integral(8, cosine);
            let numbers = RootSequence::new(5, Spread::Stratified);
            let count = 1 << 14;
            let light = |i| {
                let (x, y) = numbers.sample(i);
                let direction = sky.sample(x, y);
                sky.luminance(direction) * cosine(direction) / sky.pdf(direction)
            };
            let estimate = (0..count).map(light).sum::<f64>() / count as f64;
            // Independent numbers would be wrong by nearly a hundredth.
            assert!((estimate / truth - 1.0).abs() < 1e-3, "{estimate} {truth}");
        }
    }

    #[test]
    fn the_integral_over_texels_is_that_over_the_sphere() {
        let sky = overcast();
        let light = |d: DVec3| d.dot(DVec3::new(0.3, 0.8, -0.5)).max(0.0);
        let (directions, each) = all_directions();
        let sum: f64 = directions.map(|d| sky.luminance(d) * light(d) * each).sum();
        // Bands of equal height cut through the rows of the image.
        assert!((sky.integral(8, light) / sum - 1.0).abs() < 2e-3, "{sum}");
    }

    #[test]
    fn a_texel_too_dim_for_any_number_has_no_way_back() {
        let image = ImageMap::new(3, 1, 1, vec![1e30, 1e-30, 1e30], false).unwrap();
        let sky = Sky::ordered(&image, |column, _| column).unwrap();
        assert!(sky.inverse(DVec3::X + DVec3::Z).is_some());
        assert!(sky.inverse(-DVec3::X).is_none());
        assert_eq!(sky.pdf(-DVec3::X), 0.0);
    }

    #[test]
    fn a_black_sky_is_no_light() {
        let black = ImageMap::new(4, 2, 3, vec![0.0; 24], false).unwrap();
        assert!(Sky::new(&black).is_none());
    }
}
