//! What an example is, and the list of them.

use crate::{animal, ball, cyclone, grass, head, tree};
use pelage_strands::StrandBuffer;
use pelage_surface::{ImageMap, PolygonMesh};

/// A whole groom: everything its recipe refers to, in memory.
#[derive(Clone, Debug)]
pub struct Example {
    /// Its name, as [`names`] lists it.
    pub name: &'static str,
    /// What it shows, in one line.
    pub summary: &'static str,
    /// A commented `groom.toml`.
    pub recipe: String,
    /// File name of the mesh, as the recipe gives it.
    pub mesh_file: &'static str,
    /// The surface at rest.
    pub mesh: PolygonMesh,
    /// File name and texels of each map. All are 8-bit: maps of one channel are
    /// data; maps of three are sRGB colours, or the flat colours of groups.
    pub maps: Vec<(&'static str, ImageMap)>,
    /// File name and curves of the guides, where the recipe does not grow its own.
    pub guides: Option<(&'static str, StrandBuffer)>,
    /// File name and curves, with widths, that the mesh was swept along.
    pub curves: Option<(&'static str, StrandBuffer)>,
}

/// The examples there are, simplest first.
pub fn names() -> &'static [&'static str] {
    &["ball", "cyclone", "grass", "tree", "head", "animal"]
}

/// Makes the example called `name`; `None` where there is none of that name.
///
/// The same bytes come out on every machine and for every number of threads.
///
/// ```
/// let ball = pelage_examples::example("ball").ok_or("no such example")?;
/// assert!(ball.recipe.contains("ball.obj"));
/// assert!(pelage_examples::example("unicorn").is_none());
/// # Ok::<(), &str>(())
/// ```
pub fn example(name: &str) -> Option<Example> {
    match name {
        "ball" => Some(ball::example()),
        "cyclone" => Some(cyclone::example()),
        "grass" => Some(grass::example()),
        "tree" => Some(tree::example()),
        "head" => Some(head::example(&head::Detail::FULL)),
        "animal" => Some(animal::example(&animal::Detail::FULL)),
        _ => None,
    }
}
