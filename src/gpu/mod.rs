//! Device, buffers, pipelines and the player of recordings.
