//! A list of dispatches, and of buffers that are to be zero before them, that knows no device.

use super::{Access, Pass};

/// Dispatches in order. Each sees all that the ones before it wrote.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    zeroed: Vec<(&'static str, u64)>,
    calls: Vec<Call>,
}

/// One dispatch of a pass.
#[derive(Clone, Debug)]
pub struct Call {
    pub pass: &'static Pass,
    pub size: Size,
    /// Bytes of the pass's `params`; empty where it has none.
    pub params: Vec<u8>,
    /// Buffers bound under another name than the binding's own: (binding, buffer).
    pub renamed: Vec<(&'static str, &'static str)>,
}

/// How much of a pass to run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    /// As many invocations, in workgroups of the pass's own size.
    Items(u64),
    /// A rectangle of invocations and a layer of workgroups for each sample.
    Pixels { width: u32, height: u32, layers: u32 },
    /// As many workgroups. More than a device takes in x go on in y: kernels number them `x + y * num_workgroups.x`.
    Groups([u32; 3]),
    /// Three words of workgroup counts in a buffer, at a byte offset.
    Indirect { buffer: &'static str, offset: u64 },
}

impl Size {
    fn is_empty(&self) -> bool {
        match *self {
            Size::Items(n) => n == 0,
            Size::Pixels { width, height, layers } => width == 0 || height == 0 || layers == 0,
            Size::Groups(g) => g.contains(&0),
            Size::Indirect { .. } => false,
        }
    }
}

impl Recording {
    /// Has the first `bytes` of a buffer, a multiple of four, set to zero before the first dispatch: a device fills memory sooner than
    /// its kernels can.
    pub fn zero(&mut self, buffer: &'static str, bytes: u64) {
        debug_assert!(self.calls.is_empty(), "what is recorded already comes later than this");
        self.zeroed.push((buffer, bytes));
    }

    /// Buffers that are zero before the first dispatch, and how many bytes of them.
    pub fn zeroed(&self) -> &[(&'static str, u64)] {
        &self.zeroed
    }

    /// Appends a dispatch; one of size zero is dropped. Buffers are bound by the bindings' names unless renamed.
    pub fn run(&mut self, pass: &'static Pass, size: Size) -> CallBuilder<'_> {
        self.calls.push(Call { pass, size, params: Vec::new(), renamed: Vec::new() });
        CallBuilder { recording: self }
    }

    /// The dispatches that will really be issued.
    pub fn calls(&self) -> impl Iterator<Item = &Call> {
        self.calls.iter().filter(|call| !call.size.is_empty())
    }

    /// Whether nothing will be issued.
    pub fn is_empty(&self) -> bool {
        self.zeroed.is_empty() && self.calls().next().is_none()
    }

    /// Appends what another recording holds.
    pub fn extend(&mut self, other: Recording) {
        debug_assert!(
            self.calls.is_empty() || other.zeroed.is_empty(),
            "what is recorded already comes later than this"
        );
        self.zeroed.extend(other.zeroed);
        self.calls.extend(other.calls);
    }
}

/// Says more of the call just recorded.
pub struct CallBuilder<'a> {
    recording: &'a mut Recording,
}

impl CallBuilder<'_> {
    fn call(&mut self) -> &mut Call {
        self.recording.calls.last_mut().expect("invariant: a builder follows its call")
    }

    /// The pass's parameters.
    pub fn params<T: bytemuck::NoUninit>(mut self, params: &T) -> Self {
        let call = self.call();
        debug_assert!(call.pass.bindings.iter().any(|b| b.access == Access::Params), "{} takes none", call.pass.name);
        call.params = bytemuck::bytes_of(params).to_vec();
        self
    }

    /// Binds `buffer` where the pass says `binding`.
    pub fn bind(mut self, binding: &'static str, buffer: &'static str) -> Self {
        self.call().renamed.push((binding, buffer));
        self
    }
}

impl Call {
    /// The buffer bound under a binding's name.
    pub fn buffer(&self, binding: &'static str) -> &'static str {
        self.renamed.iter().find(|(from, _)| *from == binding).map_or(binding, |(_, to)| to)
    }
}
