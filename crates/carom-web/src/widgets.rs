//! Where the parts of the interface are, as assistive technology learns it.

use egui::accesskit::{Node, Toggled};
use egui::{Context, FullOutput, Plugin};
use serde::Serialize;

/// Listens to what the interface tells assistive technology.
#[derive(Default)]
pub struct Widgets {
    shown: Vec<Widget>,
}

/// A labelled part of the interface.
#[derive(Debug, Clone, Serialize)]
pub struct Widget {
    /// As AccessKit calls it, like `Button`.
    role: String,
    label: String,
    value: Option<String>,
    /// Left edge \[CSS px\].
    x: f64,
    /// Upper edge \[CSS px\].
    y: f64,
    /// \[CSS px\]
    width: f64,
    /// \[CSS px\]
    height: f64,
}

impl Widgets {
    /// What was shown last; begins to listen at the first call.
    pub fn shown(context: &Context) -> Vec<Widget> {
        let shown = context.with_plugin(|widgets: &mut Self| widgets.shown.clone());
        if shown.is_none() {
            context.add_plugin(Self::default());
            context.enable_accesskit();
        }
        context.request_repaint();
        shown.unwrap_or_default()
    }
}

impl Plugin for Widgets {
    fn debug_name(&self) -> &'static str {
        "widgets"
    }

    fn output_hook(&mut self, context: &Context, output: &mut FullOutput) {
        let Some(update) = &output.platform_output.accesskit_update else { return };
        let zoom = f64::from(context.zoom_factor());
        self.shown = update.nodes.iter().filter_map(|(_, node)| widget(node, zoom)).collect();
    }
}

fn widget(node: &Node, zoom: f64) -> Option<Widget> {
    let bounds = node.bounds()?;
    let number = node.numeric_value().map(|value| value.to_string());
    let toggled = node.toggled().map(|toggled| (toggled == Toggled::True).to_string());
    let text = node.value().map(str::to_owned);
    let label = node.label().map(str::to_owned).or_else(|| text.clone())?;
    Some(Widget {
        role: format!("{:?}", node.role()),
        label,
        value: number.or(toggled).or(text),
        x: bounds.x0 * zoom,
        y: bounds.y0 * zoom,
        width: bounds.width() * zoom,
        height: bounds.height() * zoom,
    })
}
