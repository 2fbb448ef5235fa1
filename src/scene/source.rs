//! The text of a scene file as it was read, with those that it extends: what an edit of the file goes out from.

use std::path::Path;
use std::sync::Arc;

use super::text::Text;

/// A scene file's own text first, behind it that of each file which the one before extends. None of a model that is opened by itself.
#[derive(Clone, Debug, Default)]
pub struct SceneText(Vec<Arc<Text>>);

impl SceneText {
    /// A file that extends none, and its text without a byte order mark.
    pub fn new(file: &Path, text: String) -> Self {
        Self(vec![Arc::new(Text::new(file, text))])
    }

    /// The file itself; none of a model.
    pub fn file(&self) -> Option<&Path> {
        self.own().map(|text| text.file.as_path())
    }

    /// What is in the file itself.
    pub fn text(&self) -> Option<&str> {
        self.own().map(|text| text.text.as_str())
    }

    /// The same chain, with another text of the file itself.
    pub fn with_text(&self, text: String) -> Self {
        let own = self.own().map(|own| Arc::new(Text::new(&own.file, text)));
        Self(own.into_iter().chain(self.0.iter().skip(1).cloned()).collect())
    }

    /// Whether the file extends another.
    pub(super) fn extends(&self) -> bool {
        self.0.len() > 1
    }

    pub(super) fn own(&self) -> Option<&Text> {
        self.0.first().map(|text| &**text)
    }

    /// All texts, the file's own first.
    pub(super) fn all(&self) -> impl DoubleEndedIterator<Item = &Text> {
        self.0.iter().map(|text| &**text)
    }

    /// Puts the text of a file before those that it extends.
    pub(super) fn put_before(&mut self, text: &Text) {
        self.0.insert(0, Arc::new(Text::new(&text.file, text.text.clone())));
    }
}
