//! A window on a scene whose texture the adapter has no room for.

use super::person::Person;
use crate::textures::room::{crowded, words};

#[test]
fn the_window_tells_of_textures_that_do_not_fit() {
    let Some(folder) = crowded() else { return };
    let mut person = Person::in_folder(folder, "a.ron", &[]);
    person.finish();
    let said = person.quit();
    assert_eq!(said.matches(&words()).count(), 1, "{said}");
    assert!(said.contains("warning: the texture `"), "{said}");
}
