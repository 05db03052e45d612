//! The command `grade`: compares recorded runs of students with the course's rule.

mod args;
mod planted;
mod refusal;
mod row;
mod table;

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use carom_grade::{ClassRun, Course, Graded, Grader, Recorded, Verdict};
use carom_scene::Library;
use carom_scene::unfinished::create_folders_of;

pub use args::Grade;

use refusal::refused;
use row::Row;

use crate::failure::{Failure, complain, legible, unwritable};
use crate::standard_input::{NAME, STANDARD};
use crate::table::{Side, Table};

/// Grades runs, lists the known mistakes, or writes a run that contains some.
pub fn grade(library: &Library, args: &Grade) -> Result<(), Failure> {
    if args.mistakes {
        return planted::list(args.json);
    }
    if !args.plant.is_empty() {
        return planted::write(&grader(library, args, args.scene.as_deref())?, args);
    }
    let names = if args.scene.is_none() { names(library)? } else { Vec::new() };
    let mut graders = Graders { library, args, names, of_scene: BTreeMap::new() };
    let reports = Reports::of(args)?;
    args.replacing.check(args.table.as_deref())?;
    let mut rows = Vec::new();
    for run in &args.runs {
        let row = graders.grade(run, &reports);
        if let Err(Failure::Usage(message) | Failure::Fault(message)) = &row
            && args.runs.len() > 1
        {
            complain(&format!("carom: {message}"));
            rows.push(Row {
                run: named(run).to_owned(),
                verdict: None,
                error: Some(message.clone()),
            });
            continue;
        }
        rows.push(Row { run: named(run).to_owned(), verdict: Some(row?), error: None });
    }
    if let Some(path) = &args.table {
        table::write(path, &rows)?;
    }
    reports.write_class(&rows)?;
    print(&rows, args.json)?;
    let broken = rows.iter().filter(|row| row.error.is_some()).count();
    if broken > 0 {
        let all = rows.len();
        return Err(Failure::Usage(format!("{broken} of {all} runs cannot be graded")));
    }
    let is_same = |row: &Row| row.verdict.as_ref().is_some_and(|it| it.same);
    if rows.iter().all(is_same) { Ok(()) } else { Err(Failure::Differs) }
}

/// One grader per scene, so that runs of the rule and of the mistakes are computed once for all
/// files.
struct Graders<'a> {
    library: &'a Library,
    args: &'a Grade,
    /// Names of scenes, if the names of files select the scene.
    names: Vec<String>,
    of_scene: BTreeMap<String, Grader>,
}

impl Graders<'_> {
    fn grade(&mut self, run: &Path, reports: &Reports) -> Result<Verdict, Failure> {
        let args = self.args;
        let scene = match &args.scene {
            Some(scene) => scene.as_str(),
            None => named_in(&self.names, named(run))?,
        };
        let grader = match self.of_scene.entry(scene.to_owned()) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(place) => place.insert(grader(self.library, args, Some(scene))?),
        };
        let reading = args.format.reading(grader.course().frame_time);
        let recorded = if run == Path::new(STANDARD) {
            Recorded::read_from(io::stdin().lock(), named(run), &reading)
        } else {
            Recorded::read(run, &reading)
        };
        let recorded = recorded.map_err(refused)?;
        let graded = grader.grade(&recorded);
        reports.write(run, grader.course(), &graded)?;
        Ok(graded.verdict)
    }
}

/// Path of a run in tables and errors, and for the name of its page.
fn named(run: &Path) -> &Path {
    if run == Path::new(STANDARD) { Path::new(NAME) } else { run }
}

fn grader(library: &Library, args: &Grade, scene: Option<&str>) -> Result<Grader, Failure> {
    let (scene, _) = args.changes.find(library, scene.unwrap_or_default(), [])?;
    Ok(Grader::new(Course::of(&scene).map_err(refused)?, args.tolerance))
}

/// Names of all scenes, the longest first.
fn names(library: &Library) -> Result<Vec<String>, Failure> {
    let mut names: Vec<String> = library.entries()?.into_iter().map(|entry| entry.name).collect();
    names.sort_by_key(|name| std::cmp::Reverse(name.len()));
    Ok(names)
}

/// Finds the scene whose name is part of the name of a file; the longest name counts.
fn named_in<'a>(names: &'a [String], run: &Path) -> Result<&'a str, Failure> {
    let stem = run.file_stem().unwrap_or_default().to_string_lossy().to_lowercase();
    let found = names.iter().find(|name| stem.contains(&name.to_lowercase()));
    found.map(String::as_str).ok_or_else(|| {
        let run = run.display();
        let problem = "the file name contains no name of a scene; --scene names one";
        Failure::Usage(format!("{run}: {problem}"))
    })
}

/// Target of the report pages.
struct Reports<'a> {
    path: Option<&'a Path>,
    /// Whether `path` is a folder with a page for each run.
    is_folder: bool,
}

impl<'a> Reports<'a> {
    /// Refuses to replace existing pages.
    fn of(args: &'a Grade) -> Result<Self, Failure> {
        let path = args.report.as_deref();
        let is_folder = args.runs.len() > 1 || path.is_some_and(Path::is_dir);
        let reports = Self { path, is_folder };
        let files: Vec<PathBuf> = args.runs.iter().filter_map(|run| reports.file(run)).collect();
        args.replacing.check(files.iter().map(PathBuf::as_path))?;
        args.replacing.check(reports.class(args.runs.len()).as_deref())?;
        let mut sorted: Vec<&PathBuf> = files.iter().collect();
        sorted.sort();
        if let Some(two) = sorted.windows(2).find(|two| two[0] == two[1]) {
            let file = two[0].display();
            return Err(Failure::Usage(format!(
                "{file}: two runs have this name; grade them apart"
            )));
        }
        if let (Some(folder), true) = (reports.path, reports.is_folder) {
            std::fs::create_dir_all(folder).map_err(|error| unwritable(folder, &error))?;
        }
        Ok(reports)
    }

    fn file(&self, run: &Path) -> Option<PathBuf> {
        let path = self.path?;
        let name = named(run).file_name().unwrap_or_default();
        let name = Path::new(name).with_extension("html");
        Some(if self.is_folder { path.join(name) } else { path.to_owned() })
    }

    fn write(&self, run: &Path, course: &Course, graded: &Graded) -> Result<(), Failure> {
        let Some(file) = self.file(run) else { return Ok(()) };
        let page = carom_grade::page(course, graded);
        let written = create_folders_of(&file).and_then(|()| std::fs::write(&file, page));
        written.map_err(|error| unwritable(&file, &error))
    }
}

impl Reports<'_> {
    /// Writes `index.html` for several runs.
    fn write_class(&self, rows: &[Row]) -> Result<(), Failure> {
        let Some(file) = self.class(rows.len()) else { return Ok(()) };
        let run = |row: &Row| {
            let page = self.file(&row.run).filter(|_| row.verdict.is_some());
            let page = page.and_then(|it| Some(it.file_name()?.to_string_lossy().into_owned()));
            (row.run.display().to_string(), page)
        };
        let named = rows.iter().map(|row| (row, run(row)));
        let runs: Vec<ClassRun> = named
            .map(|(row, (name, page))| {
                let error = row.error.as_deref().unwrap_or_default();
                ClassRun { name, page, result: row.verdict.as_ref().ok_or(error) }
            })
            .collect();
        std::fs::write(&file, carom_grade::class_page(&runs))
            .map_err(|error| unwritable(&file, &error))
    }

    /// The page of a class, if there are several runs.
    fn class(&self, runs: usize) -> Option<PathBuf> {
        self.path.filter(|_| self.is_folder && runs > 1).map(|folder| folder.join("index.html"))
    }
}

fn print(rows: &[Row], json: bool) -> io::Result<()> {
    let mut out = io::stdout().lock();
    if json {
        serde_json::to_writer_pretty(&mut out, rows)?;
        return writeln!(out);
    }
    if let [Row { run, verdict: Some(verdict), .. }] = rows {
        return print_one(&mut out, run, verdict);
    }
    let left = Side::Left;
    let mut table = Table::new(&[
        ("run", left),
        ("scene", left),
        ("result", left),
        ("departs at, s", Side::Right),
        ("contact", left),
        ("mistake", left),
        ("rows that follow", Side::Right),
    ]);
    for row in rows {
        table.push(table::cells(row).map(|cell| legible(&cell)).to_vec());
    }
    table.write(&mut out)
}

fn print_one(out: &mut impl Write, run: &Path, verdict: &Verdict) -> io::Result<()> {
    let [first, last] = verdict.time;
    let balls = if verdict.balls == 1 { "ball" } else { "balls" };
    let of_run = format!(
        "{}, {}: {} {balls}, {first:.2} to {last:.2} s, {} rows",
        run.display(),
        verdict.scene,
        verdict.balls,
        verdict.fit.rows
    );
    let heading = [("run", of_run), ("result", verdict.headline())];
    for (name, text) in heading.into_iter().chain(verdict.lines()) {
        writeln!(out, "{}", legible(&format!("{name:<11}{text}")))?;
    }
    Ok(())
}
