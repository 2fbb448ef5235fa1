//! `lucerna help`: what a command takes, with all that its values mean; and topics that are of several commands.

use clap::{Args, Command};

use super::shared::output;
use super::shared::values::{EXIT_CODES, MORE};
use super::window::keys;
use super::{Exit, Failure};

#[derive(Debug, Args)]
#[command(after_help = MORE)]
pub struct HelpArguments {
    /// A command (and its subcommand), or one of exit-codes, paths, keys
    #[arg(value_name = "COMMAND|TOPIC")]
    pub about: Vec<String>,
}

/// What values of a scene are called by `-D`, sweeps and animations.
pub const PATHS: &str = "\
A path is the fields of a scene file that lead to a value, joined by dots:

  -D film.exposure=0.5                      -D 'film.size=(640, 360)'
  -D render.max_depth=4                     -D render.integrator=Bsdf
  -D cameras.front.fov_y=30                 -D 'cameras.front.position=(0, 1, 5)'
  -D 'environment=Sky(sun: (20, 90))'       -D environment.sun.0=10
  -D 'lights.lamp.intensity=(9, 8, 7)'      -D lights.lamp=None
  -D 'models[0].transform.scale=2'          -D models.0.transform.rotate_y=30
  -D materials.clay.ns=64                   -D materials.pot:clay.kd=0.5
  -D 'materials.\"clay.001\".kd=0.5'          -D materials.clay.map_kd.scale=8

Lists and tuples are counted from 0. A name with dots stands in double quotes. A value is what would stand in the scene file, a text in
double quotes; `None` takes away. What is not there is added, where a scene file may have it. `lucerna schema` lists all fields. Sweeps of
variant files and keys of animations take the same paths.
";

/// Prints what was asked for.
pub fn run(arguments: &HelpArguments, root: Command) -> Result<Exit, Failure> {
    let about: Vec<&str> = arguments.about.iter().map(String::as_str).collect();
    let text = match about[..] {
        ["exit-codes"] => EXIT_CODES.to_owned() + "\n",
        ["paths"] => PATHS.to_owned(),
        ["keys"] => keys::listed() + "\n",
        _ => of_command(&about, root)?,
    };
    output::print(&text)?;
    Ok(Exit::Done)
}

/// The long help of a command, by its name and that of its subcommand.
fn of_command(names: &[&str], mut command: Command) -> Result<String, Failure> {
    command.build();
    for name in names {
        let found = command.find_subcommand(name).cloned();
        let Some(found) = found else {
            let known: Vec<&str> = command.get_subcommands().map(Command::get_name).collect();
            let help = format!("commands: {}; topics: exit-codes, paths, keys", known.join(", "));
            return Err(Failure::usage(format!("there is no help about `{name}`"), help));
        };
        command = found;
    }
    Ok(command.render_long_help().to_string())
}
