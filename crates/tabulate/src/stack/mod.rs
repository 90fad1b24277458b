//! Stacks of layers as TOML gives them: a file of a stack, or the table `[stack]` of a scene.
//!
//! `text` holds a stack as it is written, `interface` what joins its layers.

mod interface;
mod text;

pub use text::{NamedStack, Text};
