//! What a scene file says of a model.

use glam::{DAffine3, DMat3, DVec3};

use super::material::{MaterialEntry, read_materials};
use crate::scene::diagnostic::Diagnostic;
use crate::scene::ron::{Fields, Kind, Node, Reader};
use crate::scene::turn::read_turn;

/// One model of a scene.
#[derive(Debug)]
pub struct ModelEntry {
    /// As written: relative to the folder of the file that has it.
    pub path: String,
    /// First part of its meshes' names; the file's stem where it isn't given.
    pub name: Option<String>,
    /// The model that it moves with.
    pub parent: Option<Parent>,
    /// To the space of its parent, or of the world.
    pub transform: DAffine3,
    /// Changes to its materials alone, by their own names.
    pub materials: Vec<MaterialEntry>,
    /// An error about this entry, without its message.
    pub place: Diagnostic,
}

impl ModelEntry {
    /// A file by itself, as it is.
    pub fn alone(path: String, place: Diagnostic) -> Self {
        Self { path, name: None, parent: None, transform: DAffine3::IDENTITY, materials: Vec::new(), place }
    }
}

/// A model that another one names.
#[derive(Debug)]
pub struct Parent {
    pub name: String,
    /// An error about the name, without its message.
    pub place: Diagnostic,
}

/// `(path: "..", name: "..", parent: "..", transform: (..), materials: {..})`
pub fn read_model(reader: &Reader, node: &Node, path: &str) -> Option<ModelEntry> {
    let fields = Fields::open(reader, node, path)?;
    let named = fields.get("path").unwrap_or(node);
    let place = named.text.error(named.source, "");
    let file = fields.require("path", |node| match node.string()? {
        path if path.is_empty() => Err("expected the path of an .obj file, found an empty string".into()),
        path => Ok(path),
    });
    let name = fields.read("name", |node| match node.string()? {
        name if name.is_empty() || name.contains([':', '/']) => {
            Err("a model's name is not empty and has no `:` or `/`".into())
        }
        name => Ok(name),
    });
    let transform = match fields.get("transform") {
        Some(node) => read_transform(reader, node, &fields.path_of("transform")),
        None => Some(DAffine3::IDENTITY),
    };
    let parent = fields.read("parent", |node| match node.string()? {
        name if name.is_empty() => Err("expected the name of a model, found an empty string".into()),
        name => Ok(Parent { name, place: node.text.error(node.source, "") }),
    });
    let materials = match fields.get("materials") {
        Some(node) => read_materials(reader, node, &fields.path_of("materials")),
        None => Vec::new(),
    };
    let sound = fields.finish();
    let entry = ModelEntry { path: file?, name, parent, transform: transform?, materials, place };
    sound.then_some(entry)
}

/// Scale, then turns about x, y and z in this order, then translation; or a matrix of three rows of four.
fn read_transform(reader: &Reader, node: &Node, path: &str) -> Option<DAffine3> {
    let fields = Fields::open(reader, node, path)?;
    let matrix = fields.read("matrix", |node| {
        let rows: Vec<[f64; 4]> = node.items()?.iter().map(|row| row.numbers(-1e12, 1e12)).collect::<Result<_, _>>()?;
        let rows: [[f64; 4]; 3] = rows.try_into().map_err(|_| "expected three rows of four numbers".to_owned())?;
        let linear = DMat3::from_cols_array_2d(&[0, 1, 2].map(|row| [rows[row][0], rows[row][1], rows[row][2]]));
        Ok(DAffine3::from_mat3_translation(linear.transpose(), DVec3::from_array(rows.map(|row| row[3]))))
    });
    let scale = fields.read("scale", |node| match &node.kind {
        Kind::Items(_) => node.vector(),
        _ => node.number(-1e12, 1e12).map(DVec3::splat),
    });
    let turn = read_turn(&fields);
    let translate = fields.read("translate", Node::vector);
    if matrix.is_some() && (scale.is_some() || turn.is_some() || translate.is_some()) {
        fields.fail("`matrix` stands alone: leave out scale, rotate and translate");
    }
    let linear = turn.unwrap_or(DMat3::IDENTITY) * DMat3::from_diagonal(scale.unwrap_or(DVec3::ONE));
    let transform = matrix.unwrap_or_else(|| DAffine3::from_mat3_translation(linear, translate.unwrap_or(DVec3::ZERO)));
    let determinant = transform.matrix3.determinant();
    if !(determinant.is_finite() && determinant.abs() > 1e-100) {
        fields.fail("this transform flattens the model (its determinant is 0)");
    }
    fields.finish().then_some(transform)
}
