// Word 0 becomes fma(1 + 2^-12, 1 + 2^-12, -1 - 2^-11), which is 2^-24 if rounded once, 0 if twice. It reads the three, lest a
// compiler compute it.

@group(0) @binding(0) var<storage, read_write> words: array<f32>;

@compute @workgroup_size(1)
fn ask() {
    words[0] = fma(words[0], words[1], words[2]);
}
