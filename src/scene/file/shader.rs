//! Values of shaders' parameters in a scene file. Which of them there are, shaders say: here they have places, for who compares them.

use std::collections::BTreeMap;

use crate::components::ShaderValue;
use crate::scene::diagnostic::Diagnostic;
use crate::scene::ron::{Node, Reader};

/// Where a parameter is set: errors without their messages.
#[derive(Clone, Debug, PartialEq)]
pub struct ShaderPlace {
    pub name: Diagnostic,
    pub value: Diagnostic,
}

/// `{ "NAME": 2.0, "OTHER": true }`; `None` takes away what the file that is extended has.
pub fn read_values(reader: &Reader, node: &Node, path: &str) -> BTreeMap<String, (ShaderValue, ShaderPlace)> {
    let fields = node.fields().map_err(|message| reader.error(node, path, message)).unwrap_or_default();
    let mut values = BTreeMap::new();
    for (name, place, node) in fields.iter().filter(|(.., node)| !node.is_none()) {
        let switch = node.boolean().ok().map(ShaderValue::Switch);
        let number = || node.number(f64::MIN, f64::MAX).ok().map(ShaderValue::Number);
        match switch.or_else(number) {
            Some(value) => {
                let place = ShaderPlace { name: node.text.error(place, ""), value: node.text.error(node.source, "") };
                values.insert(name.clone(), (value, place));
            }
            None => {
                let message = format!("expected a number, true or false, found {}", node.describe());
                reader.error(node, &format!("{path}.{name}"), message);
            }
        }
    }
    values
}
