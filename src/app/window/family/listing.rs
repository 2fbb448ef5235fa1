//! The members of a family by name, and which of them is wanted.

/// Names in the order of the file, of which one is wanted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    names: Vec<String>,
    /// Below the number of names, where there are any.
    wanted: usize,
}

impl Listing {
    /// The first one is wanted.
    pub fn new(names: Vec<String>) -> Self {
        Self { names, wanted: 0 }
    }

    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The one that is wanted.
    pub fn wanted(&self) -> Option<&str> {
        self.names.get(self.wanted).map(String::as_str)
    }

    /// The place of a name, from 0.
    pub fn place(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|known| known == name)
    }

    /// Wants the one that is `by` places farther; behind the last comes the first.
    pub fn step(&mut self, by: i32) {
        if let Ok(count) = i64::try_from(self.names.len())
            && count > 0
        {
            let place = (self.wanted as i64 + i64::from(by)).rem_euclid(count);
            self.wanted = place as usize;
        }
    }

    /// Wants the one of a name. False if there is none.
    pub fn choose(&mut self, name: &str) -> bool {
        let place = self.place(name);
        self.wanted = place.unwrap_or(self.wanted);
        place.is_some()
    }

    /// Has other members. The one that is wanted stays so; where it is gone, the one that is in its place now, or the last.
    pub fn replace(&mut self, names: Vec<String>) {
        let wanted = self.wanted().and_then(|wanted| names.iter().position(|name| name == wanted));
        self.wanted = wanted.unwrap_or(self.wanted.min(names.len().saturating_sub(1)));
        self.names = names;
    }
}
