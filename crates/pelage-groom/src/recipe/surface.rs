//! `[surface]`: the mesh that grows hair. The default names no mesh; a recipe
//! read from text always does.

use super::entry::Rule;
use super::path::FilePath;
use super::section::section;
use super::word::words;

words! {
    /// The axis that points up.
    pub enum Up {
        /// +Y, as in Maya and USD's default.
        Y = "y",
        /// +Z, as in Blender and Houdini's exports.
        Z = "z",
    }
}

section! {
    /// The mesh that grows hair.
    pub struct Surface {
        /// The mesh in its rest pose, which decides where hairs grow.
        pub mesh: FilePath = FilePath::default() => Rule::ANY.required(),
        /// The mesh in the pose to be dressed: one file, a file with time samples,
        /// or one file a frame with `#` for the digits of the frame number
        /// (`body.####.obj`). Left out, the rest pose.
        pub posed: Option<FilePath> = None => Rule::ANY,
        /// The axis that points up in the mesh. Left out, what the file says, or
        /// +Y where it says nothing.
        pub up: Option<Up> = None => Rule::ANY,
        /// Metres in one unit of the mesh (0.01: centimetres). Left out, what the
        /// file says, or 0.01 where it says nothing.
        pub meters_per_unit: Option<f64> = None => Rule::above(0.0).unit("metres"),
    }
}
