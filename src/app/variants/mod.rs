//! Renders the members of a family of scenes, each as its scene alone would be, and answers with pictures, tables and a page.

pub mod record;
