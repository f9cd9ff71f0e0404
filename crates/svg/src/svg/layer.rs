use scumble_scene::Command;

/// Begins a layer of the given opacity; the token closes it.
pub(super) fn open(commands: &mut Vec<Command>, opacity: f32) -> usize {
    commands.push(Command::PushLayer { opacity });
    commands.len()
}

/// Ends the layer that began at `start`. An empty one goes without a trace. One with a single
/// command gives its opacity to that: a colour c of alpha α, painted apart and then laid down
/// with opacity o, is c of alpha α·o.
pub(super) fn close(commands: &mut Vec<Command>, start: usize, opacity: f32) {
    let inside = commands.get_mut(start..).unwrap_or_default();
    let needless = match inside {
        [] => true,
        [only] => fade(only, opacity),
        _ => false,
    };
    if needless {
        commands.remove(start - 1);
    } else {
        commands.push(Command::PopLayer);
    }
}

/// Multiplies a command's alpha; `false` if it has none.
fn fade(command: &mut Command, opacity: f32) -> bool {
    match command {
        Command::Fill(c) => c.color.0[3] *= opacity,
        Command::Stroke(c) => c.color.0[3] *= opacity,
        Command::Hairline(c) => c.color.0[3] *= opacity,
        Command::Point(c) => c.color.0[3] *= opacity,
        Command::Gouraud(c) => c.colors.iter_mut().for_each(|color| color.0[3] *= opacity),
        Command::Textured(c) => c.opacity *= opacity,
        Command::Image(c) => c.opacity *= opacity,
        Command::PushLayer { .. } | Command::PopLayer => return false,
    }
    true
}
