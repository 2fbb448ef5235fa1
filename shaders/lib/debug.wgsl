// What code shows of itself in view "debug", in place of the film.

// The colour that was shown last, and 1 once one was.
var<private> debug_colour: vec4<f32>;

// Shows a colour for the pixel whose path this is: of its first sample, and of several calls the last. In every pass but that view it
// does nothing.
fn debug(colour: vec3<f32>) {
    @if(debug_view) {
        debug_colour = vec4<f32>(colour, 1.0);
    }
}
