//! What the cub looks like at a place: the functions behind its maps.

use super::pelt::label;
use super::regions::{
    Shares, along_tail, belly, chest, from_eye, from_nose, inner_ear, shares, up_the_muzzle,
};
use super::shape::{EYE, EYE_RADIUS, Part};
use crate::hash::{fractal, smoothstep};
use crate::sdf::Solid;
use glam::DVec3;

/// A place on the cub and all that its look depends on.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    /// Raggedness of edges here: a small number that differs from tuft to tuft.
    ragged: f64,
    /// How far along the tail the place is, 0..1.
    along_tail: f64,
    /// Position.
    pub p: DVec3,
    /// Unit normal.
    pub normal: DVec3,
    /// Memberships.
    pub shares: Shares,
    /// Label of the triangle.
    pub label: u8,
}

/// Colours are sRGB, as painted.
fn hex(code: u32) -> DVec3 {
    DVec3::new(
        (code >> 16 & 255) as f64,
        (code >> 8 & 255) as f64,
        (code & 255) as f64,
    ) / 255.0
}

impl Spot {
    /// The spot at `p` on a triangle with `label`.
    pub fn new(body: &Solid<Part>, p: DVec3, normal: DVec3, label: u8) -> Self {
        Self {
            ragged: fractal(11, p * 38.0) * 0.5 + fractal(12, p * 110.0) * 0.4,
            along_tail: along_tail(p),
            p,
            normal,
            shares: shares(body, p),
            label,
        }
    }

    /// Whether no hair grows on the triangle at all.
    fn is_bare(&self) -> bool {
        self.label >= label::SOLE
    }

    /// Hairs for each area, 0..1.
    pub fn density(&self) -> f64 {
        if self.is_bare() {
            return 0.0;
        }
        let eyes = smoothstep(EYE_RADIUS + 0.004, EYE_RADIUS + 0.016, from_eye(self.p));
        let nose = smoothstep(0.022, 0.040, from_nose(self.p));
        let ear = 1.0 - 0.4 * inner_ear(self.p, self.normal);
        let pads = smoothstep(0.004, 0.016, self.p.y);
        let lips = 1.0 - 0.65 * self.lips();
        let part = self.shares.mix(0.66, 0.80, 1.0, 0.90, 0.80, 0.85);
        part * eyes * nose * ear * pads * lips
    }

    /// 1 where the mouth opens: the cleft between muzzle and jaw.
    fn lips(&self) -> f64 {
        let line = 0.580 + 0.25 * self.p.x.abs();
        let near = 1.0 - smoothstep(0.002, 0.009, (self.p.y - line).abs());
        near * smoothstep(0.45, 0.48, self.p.z) * self.shares.head
    }

    /// Trims the guides, 0..1: small where they would hide the face.
    pub fn length(&self) -> f64 {
        if self.is_bare() {
            return 0.0;
        }
        let eyes = 0.55 + 0.45 * smoothstep(0.01, 0.05, from_eye(self.p) - EYE_RADIUS);
        let nose = 0.55 + 0.45 * smoothstep(0.02, 0.08, from_nose(self.p));
        let ear = 1.0 - 0.35 * inner_ear(self.p, self.normal);
        let lips = 1.0 - 0.5 * self.lips();
        let tufts = 0.90 + 0.10 * fractal(21, self.p * 24.0);
        tufts * eyes * nose * ear * lips
    }

    /// 1 where the fur is white.
    fn white(&self) -> f64 {
        let r = self.ragged;
        let p = self.p;
        let torso = belly(p, self.normal).max(chest(p, self.normal) * 0.98);
        let bib = smoothstep(0.35, 0.65, torso + 0.25 * r);
        let side = smoothstep(0.035, 0.075, p.x.abs()) * 0.03;
        let face_line = 0.612 + 0.30 * (p.z - 0.44) + side - 0.004;
        let face = smoothstep(0.012, -0.012, p.y - face_line + 0.016 * r)
            * smoothstep(0.25, 0.31, p.z + 0.02 * r);
        let brow = self.brow() * 0.9;
        let ear = inner_ear(p, self.normal) * 0.85;
        let tip = smoothstep(0.70, 0.80, self.along_tail + 0.09 * r);
        (self.shares)
            .mix(bib, bib.max(face * 0.6), face.max(brow), ear, 0.0, tip)
            .clamp(0.0, 1.0)
    }

    /// 1 on the pale spots above the eyes.
    fn brow(&self) -> f64 {
        let spot = DVec3::new(0.050, 0.722, 0.452);
        let p = DVec3::new(self.p.x.abs(), self.p.y, self.p.z);
        1.0 - smoothstep(0.010, 0.026, p.distance(spot) + 0.004 * self.ragged)
    }

    /// 1 where the fur is nearly black: socks, ear tips, the tail's band.
    fn dark(&self) -> f64 {
        let r = self.ragged;
        let p = self.p;
        let sock = smoothstep(0.165, 0.105, p.y + 0.035 * r);
        let ear = smoothstep(0.825, 0.870, p.y + 0.02 * r) * (1.0 - inner_ear(p, self.normal));
        let along = self.along_tail + 0.07 * r;
        let band = smoothstep(0.52, 0.66, along) * (1.0 - smoothstep(0.70, 0.80, along));
        let tear = self.tear_line() * 0.75;
        self.shares
            .mix(0.0, 0.0, tear, ear, sock, band * 0.8)
            .clamp(0.0, 1.0)
    }

    /// 1 on the dark line from the eye down to the muzzle.
    fn tear_line(&self) -> f64 {
        let p = DVec3::new(self.p.x.abs(), self.p.y, self.p.z);
        let eye = DVec3::from(EYE) + DVec3::new(-0.016, -0.010, 0.01);
        let end = DVec3::new(0.028, 0.616, 0.512);
        let near = super::regions::segment_nearest(p, eye, end).distance(p);
        let lids = 1.0 - smoothstep(EYE_RADIUS + 0.007, EYE_RADIUS + 0.018, from_eye(p));
        (1.0 - smoothstep(0.006, 0.016, near + 0.003 * self.ragged)).max(lids)
    }

    /// 1 on the saddle along the spine.
    fn saddle(&self) -> f64 {
        let r = self.ragged;
        let spine = smoothstep(0.45, 0.95, self.normal.y + 0.22 * r);
        let crown = smoothstep(0.5, 0.9, self.normal.y + 0.2 * r) * up_the_muzzle(self.p);
        self.shares
            .mix(spine, spine * 0.9, crown * 0.5, 0.2, 0.0, spine * 0.7)
    }

    /// Colour of the hair's tip, sRGB.
    pub fn tip_color(&self) -> DVec3 {
        if self.is_bare() {
            return self.skin_color();
        }
        let coat = hex(0xD0742E)
            .lerp(hex(0xB4551D), 0.5 + 0.5 * fractal(31, self.p * 17.0))
            .lerp(hex(0x7E3D17), 0.75 * self.saddle());
        coat.lerp(hex(0x34211A), self.dark())
            .lerp(hex(0xF6EBD9), self.white() * (1.0 - self.dark()))
    }

    /// Colour of the hair at the skin, sRGB: a duller, darker underfur.
    pub fn root_color(&self) -> DVec3 {
        if self.is_bare() {
            return self.skin_color();
        }
        let under = hex(0x7A4A2A)
            .lerp(hex(0x6A5344), 0.35 * self.saddle())
            .lerp(hex(0x20160F), self.dark());
        under.lerp(hex(0xC9B598), self.white() * (1.0 - self.dark()))
    }

    /// Colour of the skin, sRGB: like the fur's shadow where fur grows.
    pub fn skin_color(&self) -> DVec3 {
        match self.label {
            label::SOLE => hex(0x2B201D),
            label::NOSE.. => hex(0x15110F),
            label::EYE.. => self.eye_color(),
            _ => {
                let furred = self.root_color() * 0.62;
                let ear = inner_ear(self.p, self.normal) * 0.7;
                let rim = 1.0 - smoothstep(0.002, 0.009, from_eye(self.p) - EYE_RADIUS);
                let snout = 1.0 - smoothstep(0.024, 0.034, from_nose(self.p));
                let lips = self.lips() * 0.8;
                furred
                    .lerp(hex(0xA9776A), ear)
                    .lerp(hex(0x1B1411), rim.max(snout).max(lips))
            }
        }
    }

    /// A large pupil in amber, with a glint.
    fn eye_color(&self) -> DVec3 {
        let side = self.p.x.signum();
        let center = DVec3::new(EYE[0] * side, EYE[1], EYE[2]);
        let n = (self.p - center).normalize_or(DVec3::Z);
        let gaze = DVec3::new(0.38 * side, 0.02, 1.0).normalize();
        let away = 1.0 - n.dot(gaze);
        let iris = hex(0x8A4A12).lerp(hex(0xD8922E), smoothstep(0.14, 0.30, away));
        let glint = DVec3::new(0.38 * side + 0.22, 0.34, 1.0).normalize();
        iris.lerp(hex(0x0B0807), 1.0 - smoothstep(0.13, 0.17, away))
            .lerp(hex(0x120C09), smoothstep(0.34, 0.42, away))
            .lerp(DVec3::ONE, smoothstep(0.984, 0.990, n.dot(glint)))
    }
}
