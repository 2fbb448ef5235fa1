// Apart from the traversal, so that a test can make the stack tiny and a benchmark can tune both.

// Entries of a ray's stack, a power of two. Trees of Morton codes seldom need as many, and whatever they need, no
// hit is lost: see traverse.wgsl.
const STACK_SIZE: u32 = 16u;

// Nodes visited at most before leaves are tested. A ray meets a leaf every tenth node or so. With 1, a GPU would test
// leaves after every node for the few rays of a subgroup that have one; with many, the others would wait for the last. A
// processor's eight lanes are few, and a test that none of them needs takes as long as one that all do.
@if(!software) const VISITS_PER_LEAF: u32 = 4u;
@if(software) const VISITS_PER_LEAF: u32 = 64u;
