//! What is held on a device: bytes of buffers, now and at most. What the driver takes beside them, and what it has left, nobody tells.

/// Bytes of all buffers together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Held {
    pub now: u64,
    /// The most that there were at once.
    pub most: u64,
}

impl Held {
    /// A buffer of so many bytes came.
    pub fn add(&mut self, bytes: u64) {
        self.now += bytes;
        self.most = self.most.max(self.now);
    }

    /// One of so many went.
    pub fn take(&mut self, bytes: u64) {
        self.now = self.now.saturating_sub(bytes);
    }
}

/// The memory of a device, as far as it is ours.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DeviceMemory {
    pub held: Held,
    /// The buffers that there are, by name, with their bytes; the largest first.
    pub buffers: Vec<(&'static str, u64)>,
}
