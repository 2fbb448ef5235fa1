// Apart from the traversal, so that a test can make it tiny.

// Entries of a ray's stack, a power of two. Trees of Morton codes seldom need as many, and whatever they need, no
// hit is lost: see traverse.wgsl.
const STACK_SIZE: u32 = 32u;
