//! Scenes that are hard to hit, and trees that no pass has built.

pub use lucerna::stress::scenes::rays::{direction, endless, hard_rays, point_in_cube, random_rays, rays_at_edges};
pub use lucerna::stress::scenes::solids::{
    concentric, coplanar, degenerate, flat_grid, hard_scenes, slivers, soup, sphere,
};
pub use lucerna::stress::tools::trees::{Cut, build, records};
