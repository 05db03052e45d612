//! The controls of the interface as assistive technology sees them, and actions on them.

use std::collections::{BTreeMap, BTreeSet};

use egui::accesskit::{Action, ActionData, ActionRequest, Node, NodeId, Role, Toggled, TreeId};
use egui::{Context, Event, FullOutput, Plugin, RawInput};
use serde::Serialize;

/// Receives what the interface reports to assistive technology, and passes on actions.
#[derive(Default)]
pub struct Widgets {
    shown: Vec<Widget>,
    /// Actions for the next frame.
    requests: Vec<ActionRequest>,
}

/// A labelled control of the interface.
#[derive(Debug, Clone, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Widget {
    /// Identifies the control in requests; the same in all frames.
    id: String,
    /// Role by its name in AccessKit, for example `Button`.
    role: String,
    label: String,
    value: Option<String>,
    /// Smallest and largest value of a number.
    range: Option<[f64; 2]>,
    disabled: bool,
    /// Whether its text cannot be edited.
    read_only: bool,
    /// Left edge \[CSS px\].
    x: f64,
    /// Upper edge \[CSS px\].
    y: f64,
    /// Width \[CSS px\].
    width: f64,
    /// Height \[CSS px\].
    height: f64,
}

impl Widgets {
    /// Returns the controls as last drawn, in reading order. The first call starts the recording.
    pub fn shown(context: &Context) -> Vec<Widget> {
        let shown = context.with_plugin(|widgets: &mut Self| widgets.shown.clone());
        if shown.is_none() {
            context.add_plugin(Self::default());
            context.enable_accesskit();
        }
        context.request_repaint();
        shown.unwrap_or_default()
    }

    /// Presses the control with this id, or sets its value. Does nothing if the control no longer
    /// exists or [`Self::shown`] was never called.
    pub fn ask(context: &Context, id: &str, value: Option<ActionData>) {
        let Ok(id) = id.parse() else { return };
        let request = ActionRequest {
            action: if value.is_some() { Action::SetValue } else { Action::Click },
            target_tree: TreeId::ROOT,
            target_node: NodeId(id),
            data: value,
        };
        context.with_plugin(|widgets: &mut Self| widgets.requests.push(request));
        context.request_repaint();
    }
}

impl Plugin for Widgets {
    fn debug_name(&self) -> &'static str {
        "widgets"
    }

    fn input_hook(&mut self, _context: &Context, input: &mut RawInput) {
        input.events.extend(self.requests.drain(..).map(Event::AccessKitActionRequest));
    }

    fn output_hook(&mut self, context: &Context, output: &mut FullOutput) {
        let Some(update) = &output.platform_output.accesskit_update else { return };
        let zoom = f64::from(context.zoom_factor());
        let nodes: BTreeMap<NodeId, &Node> =
            update.nodes.iter().map(|(id, it)| (*id, it)).collect();
        let inner: BTreeSet<NodeId> =
            nodes.values().flat_map(|it| it.children()).copied().collect();
        self.shown.clear();
        // Depth first, children in their order.
        let outer = update.nodes.iter().map(|(id, _)| *id).filter(|id| !inner.contains(id));
        let mut waiting: Vec<NodeId> = outer.collect();
        waiting.reverse();
        while let Some(id) = waiting.pop() {
            let Some(node) = nodes.get(&id) else { continue };
            self.shown.extend(widget(id, node, zoom));
            waiting.extend(node.children().iter().rev());
        }
    }
}

fn widget(id: NodeId, node: &Node, zoom: f64) -> Option<Widget> {
    let bounds = node.bounds()?;
    // The value of a field contains its lines.
    if node.role() == Role::TextRun {
        return None;
    }
    let number = node.numeric_value().map(|value| value.to_string());
    let toggled = node.toggled().map(|toggled| (toggled == Toggled::True).to_string());
    let text = node.value().map(str::to_owned);
    // An empty field is named by its placeholder.
    let own = node.label().or(node.placeholder()).map(str::to_owned);
    let label = own.or_else(|| text.clone())?;
    Some(Widget {
        id: id.0.to_string(),
        role: format!("{:?}", node.role()),
        label,
        value: number.or(toggled).or(text),
        range: node.min_numeric_value().zip(node.max_numeric_value()).map(<[f64; 2]>::from),
        disabled: node.is_disabled(),
        read_only: node.is_read_only(),
        x: bounds.x0 * zoom,
        y: bounds.y0 * zoom,
        width: bounds.width() * zoom,
        height: bounds.height() * zoom,
    })
}
