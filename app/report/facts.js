"use strict";

// How the results were made: run.json as lists and tables.

const isScalar = (value) => value === null || typeof value !== "object";
const scalarText = (value) =>
    (value === null                 ? "none" :
         typeof value === "number"  ? plain(value, 6) :
         typeof value === "boolean" ? (value ? "yes" : "no") :
                                      value || "–");

function factsOf(value) {
  if (isScalar(value)) return element("span", {textContent: scalarText(value)});
  if (Array.isArray(value) && value.every(isScalar)) return element("span", {textContent: value.map(scalarText).join(", ") || "none"});
  if (Array.isArray(value)) return tableOf(value);
  const list = element("dl");
  for (const [key, one] of Object.entries(value)) list.append(element("dt", {textContent: key}), element("dd", {}, factsOf(one)));
  return list;
}

/// Objects with the same keys: a row each, or a column each where they have more keys than there are objects.
function tableOf(objects) {
  const keys = [...new Set(objects.flatMap((one) => Object.keys(one)))];
  const cell = (one, key) => element("td", {}, factsOf(one[key] ?? null));
  const heading = (key, scope) => element("th", {scope, textContent: key});
  const parts = keys.length > objects.length ?
      [element("tbody", {}, ...keys.map((key) => element("tr", {}, heading(key, "row"), ...objects.map((one) => cell(one, key)))))] :
      [
        element("thead", {}, element("tr", {}, ...keys.map((key) => heading(key, "col")))),
        element("tbody", {}, ...objects.map((one) => element("tr", {}, ...keys.map((key) => cell(one, key)))))
      ];
  return element("div", {className: "scroll"}, element("table", {}, ...parts));
}

function showFacts(run) {
  const elsewhere = new Set(["title", "warnings", "notes", "scene text"]);
  for (const [name, value] of Object.entries(run)) {
    if (elsewhere.has(name) || isScalar(value) || Object.keys(value).length === 0) continue;
    byId("facts").append(element("section", {className: "card"}, element("h3", {textContent: name}), factsOf(value)));
  }
  const single = Object.fromEntries(Object.entries(run).filter(([name, value]) => !elsewhere.has(name) && isScalar(value) && value !== ""));
  byId("facts").prepend(element("section", {className: "card"}, element("h3", {textContent: "run"}), factsOf(single)));
  byId("scene-text").textContent = run["scene text"] ?? "";
  byId("scene-text").parentElement.hidden = !run["scene text"];
}

function showHead(title, run, onlyRow = null) {
  byId("title").textContent = title;
  const took = run["timings [s]"]?.integration ?? run["timings [s]"]?.computing;
  const words = [];
  const unstable = run.stability?.["unstable directions"] ?? 0;
  if (run.status) words.push(run.status + (run.reason ? `: ${run.reason}` : ""));
  if (run.found === false) words.push(`not at rest: ${run.reason}`);
  if (unstable > 0) words.push(`unstable in ${unstable} ${unstable === 1 ? "direction" : "directions"}`);
  if (run["reached [s]"] !== undefined) words.push(`to ${engineering(run["reached [s]"], "s", 6)}`);
  if (onlyRow !== null) words.push(`one row, at ${engineering(onlyRow, "s", 6)}: its values are below`);
  if (run.method?.name) words.push(`by ${run.method.name}`);
  if (run.counts?.steps) words.push(`${run.counts.steps} steps`);
  if (took !== undefined) words.push(`computed in ${engineering(took, "s", 3)}`);
  if (run.program) words.push(`${run.program} ${run.version}`);
  byId("summary").textContent = words.join(" · ");
  byId("summary").classList.toggle("trouble", run.found === false || unstable > 0 || (run.status ?? "finished") !== "finished");
  const warnings = [...(run.warnings ?? []), ...(run.notes ?? [])];
  byId("warnings").hidden = warnings.length === 0;
  byId("warnings").append(...warnings.map((text) => element("li", {textContent: text})));
}
