//! Pelage grows hair and fur on triangle meshes.
//!
//! This crate gathers what a program needs that wants hair: [`load`] a recipe with
//! everything it names, [`generate`] its strands into any [`Sink`], and draw a
//! picture with [`render`]. The crates below can be used by themselves.
//!
//! ```no_run
//! use pelage::{Collect, Pose, generate, load};
//!
//! let loaded = load("groom.toml".as_ref())?;
//! let mut strands = Collect::default();
//! let request = loaded.request(0..1000, 2);
//! generate(&loaded.plan, &request, &mut |_| Ok(Pose::default()), &mut strands, &mut |_| true)?;
//! assert_eq!(strands.strands.len(), 1000);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod load;
mod poses;
mod udim;

pub use load::{Loaded, LoadedRoots, load, load_roots, load_with};
pub use poses::{PoseFiles, PoseSource};

pub use pelage_curves as curves;
pub use pelage_examples as examples;
pub use pelage_groom as groom;
pub use pelage_io as io;
pub use pelage_render as render;
pub use pelage_strands as strands;
pub use pelage_surface as surface;

pub use pelage_groom::recipe::Recipe;
pub use pelage_groom::{
    Groom, Order, Plan, Pose, Report, Request, RootPlan, generate, write_roots,
};
pub use pelage_strands::{Collect, Sink, StrandBuffer};
