// Numbers that code shows of itself. `probe("name", value);` in any module is a call of one of these where somebody listens: in view "probe"
// (`probe_view`), and where a path is replayed (`record`). Elsewhere it is nothing.

import package::gen::{PROBE_BOOL, PROBE_F32, PROBE_U32, PROBE_VEC2, PROBE_VEC3};
import package::gen::{MOST_PROBED_OF_TURN, PROBE_FIRST, ProbeChoice, Probed};

// Path segments before the one at whose end the path is.
var<private> probe_bounce: u32;

// What the view asks for.
var<private> probe_choice: ProbeChoice;

// The first number that was asked for, and behind it 1 + its type; all 0 before there is one.
var<private> probe_value: vec4<f32>;

// What was shown since the last ray was traced, and how often, what found no room included.
var<private> probed_of_turn: array<Probed, MOST_PROBED_OF_TURN>;
var<private> probed_count: u32;

fn show_number(name: u32, kind: u32, value: vec3<f32>, bits: vec3<u32>) {
    @if(probe_view) {
        let asked = name == probe_choice.name && (probe_choice.bounce == PROBE_FIRST || probe_choice.bounce == probe_bounce);
        if (asked && probe_value.w == 0.0) {
            probe_value = vec4<f32>(value, f32(kind + 1u));
        }
    }
    @if(record) {
        if (probed_count < MOST_PROBED_OF_TURN) {
            probed_of_turn[probed_count] = Probed(bits, kind, name, probe_bounce, 0u, 0u);
        }
        probed_count += 1u;
    }
}

fn probe_f32(name: u32, value: f32) {
    show_number(name, PROBE_F32, vec3<f32>(value, 0.0, 0.0), vec3<u32>(bitcast<u32>(value), 0u, 0u));
}

fn probe_u32(name: u32, value: u32) {
    show_number(name, PROBE_U32, vec3<f32>(f32(value), 0.0, 0.0), vec3<u32>(value, 0u, 0u));
}

fn probe_bool(name: u32, value: bool) {
    show_number(name, PROBE_BOOL, vec3<f32>(f32(value), 0.0, 0.0), vec3<u32>(u32(value), 0u, 0u));
}

fn probe_vec2f(name: u32, value: vec2<f32>) {
    show_number(name, PROBE_VEC2, vec3<f32>(value, 0.0), vec3<u32>(bitcast<vec2<u32>>(value), 0u));
}

fn probe_vec3f(name: u32, value: vec3<f32>) {
    show_number(name, PROBE_VEC3, value, bitcast<vec3<u32>>(value));
}
