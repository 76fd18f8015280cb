//! A picture of strands on the CPU: no GPU, no display, no system library.
//!
//! Strands (Catmull-Rom curves with duplicated ends) are cut into short linear
//! leaves under a bounding volume hierarchy; every ray gathers the nearest
//! leaves it crosses, sorted by depth, and blends them. Hair is lit by a
//! Marschner model with dual scattering (or by Kajiya and Kay's); how many fibres
//! stand between a fibre and a light comes from deep shadow maps, softened with a
//! density grid, which also says how much sky is seen.
//!
//! The same scene and settings give the same bytes on every machine and for any
//! number of threads: transcendental functions come from `libm`, nothing is
//! fused, random numbers are hashes of pixel and sample, and hits at equal depth
//! are ordered by index.
//!
//! ```
//! use pelage_render::{Camera, Scene, Settings, UpAxis, render};
//! use pelage_strands::StrandBuffer;
//!
//! let mut strands = StrandBuffer::new();
//! strands.points = vec![[0.0; 3], [0.0, 1.0, 0.0], [0.3, 2.0, 0.0]];
//! strands.widths = vec![0.1, 0.1, 0.0];
//! strands.offsets = vec![0, 3];
//! let scene = Scene::of_strands(&strands);
//! let settings = Settings { width: 32, height: 18, samples: 4, ..Settings::default() };
//! let camera = Camera::framing(&scene.bounds(), UpAxis::Y, settings.aspect());
//! let picture = render(&scene, &camera, &settings, |_| ()).unwrap();
//! assert_eq!(picture.rgb.len(), 32 * 18);
//! ```

mod accel;
mod azimuth;
mod backdrop;
mod camera;
mod color;
mod deep_map;
mod density;
mod dual_scattering;
mod error;
mod film;
mod floor;
mod kajiya_kay;
mod leaf;
mod light_field;
mod lights;
mod longitudinal;
mod marschner;
mod picture;
mod render;
mod sampling;
mod scene;
mod settings;
mod shade;
mod skin;
mod stage;
mod tessellate;

pub use backdrop::Backdrop;
pub use camera::Camera;
pub use error::RenderError;
pub use lights::{Light, LightRig, Sky};
pub use pelage_strands::UpAxis;
pub use picture::Picture;
pub use render::render;
pub use scene::{Paint, Scene};
pub use settings::{Fiber, Reflection, Settings, Shape};
