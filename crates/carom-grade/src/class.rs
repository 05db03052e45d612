//! Writes the results of many runs as one HTML page.

use std::collections::BTreeMap;

use crate::svg::escaped;
use crate::verdict::Verdict;

const STYLE: &str = include_str!("report.css");

/// A run of a class.
#[derive(Debug, Clone)]
pub struct ClassRun<'a> {
    /// Name of the file.
    pub name: String,
    /// Address of the run's own page, if there is one.
    pub page: Option<String>,
    /// The verdict, or why the run cannot be graded.
    pub result: Result<&'a Verdict, &'a str>,
}

/// Writes a page with a table of all runs and the numbers of equal verdicts.
pub fn class_page(runs: &[ClassRun]) -> String {
    let rows: String = runs.iter().map(row).collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width\"><title>Graded runs</title>\
         <style>{STYLE}</style></head><body><h1>{} runs</h1>\n{}\n\
         <table class=\"runs\"><tr><th>run</th><th>scene</th><th>result</th><th>cause</th><th>rows that follow</th>\
         </tr>{rows}</table>\n</body></html>\n",
        runs.len(),
        histogram(runs)
    )
}

/// Bars of the numbers of equal verdicts, the most frequent first.
fn histogram(runs: &[ClassRun]) -> String {
    let mut counts = BTreeMap::<String, usize>::new();
    for run in runs {
        *counts.entry(kind(run)).or_default() += 1;
    }
    let mut counts: Vec<(String, usize)> = counts.into_iter().collect();
    counts.sort_by(|a, b| b.1.cmp(&a.1).then(a.0.cmp(&b.0)));
    let most = counts.first().map_or(1, |it| it.1);
    let bar = |(kind, count): (String, usize)| {
        let width = 100.0 * count as f64 / most as f64;
        // Green for right runs, grey for those without a verdict.
        let class = match kind.as_str() {
            kind if kind.starts_with("same") => "right",
            "cannot be read" | "compared in part" => "open",
            _ => "wrong",
        };
        format!(
            "<tr><td>{}</td><td>{count}</td><td class=\"bars\">\
             <i class=\"{class}\" style=\"width: {width:.0}%\"></i></td></tr>",
            escaped(&kind)
        )
    };
    let bars: String = counts.into_iter().map(bar).collect();
    format!("<table class=\"histogram\">{bars}</table>")
}

/// Kind of a result, by which runs are counted.
fn kind(run: &ClassRun) -> String {
    let Ok(verdict) = run.result else { return "cannot be read".to_owned() };
    if let Some(best) = verdict.explanations.first() {
        let mistakes = best.cause.mistakes.iter().map(|it| it.name().to_owned());
        // Values differ from run to run.
        let numbers = best.cause.numbers.iter().map(|it| format!("wrong {}", it.quantity));
        let causes = mistakes.chain(numbers).collect::<Vec<_>>().join(" + ");
        return if best.nearest { format!("nearest: {causes}") } else { causes };
    }
    match verdict {
        Verdict { same: true, form, .. } if form.is_empty() => "same".to_owned(),
        Verdict { same: true, .. } => "same in another form".to_owned(),
        Verdict { scatter: Some(_), fit, .. } if fit.is_complete() => {
            "same but for scatter".to_owned()
        }
        Verdict { departure: None, .. } => "compared in part".to_owned(),
        _ => "departs, not explained".to_owned(),
    }
}

fn row(run: &ClassRun) -> String {
    let name = match &run.page {
        Some(page) => format!("<a href=\"{}\">{}</a>", escaped(page), escaped(&run.name)),
        None => escaped(&run.name),
    };
    let verdict = match run.result {
        Ok(verdict) => verdict,
        Err(error) => {
            let error = escaped(error);
            return format!(
                "<tr><td>{name}</td><td></td><td colspan=\"3\" data-label=\"cannot be read\">{error}</td></tr>"
            );
        }
    };
    let best = verdict.explanations.first();
    let fit = best.map_or(&verdict.fit, |it| &it.fit);
    // On narrow screens, cells stand below one another, each with its label.
    format!(
        "<tr><td>{name}</td><td data-label=\"scene\">{}</td><td data-label=\"result\">{}</td>\
         <td data-label=\"cause\">{}</td><td data-label=\"rows that follow\">{:.1} %</td></tr>",
        escaped(&verdict.scene),
        escaped(&verdict.headline()),
        best.map_or(String::new(), |it| escaped(&it.in_a_table())),
        100.0 * fit.part()
    )
}
