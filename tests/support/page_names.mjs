// Names in the scripts of the page, by the parser that Node.js has inside: node --expose-internals page_names.mjs
// Reads {file: source} from stdin; writes {file: {unknown, unused}}: names that are read and nowhere declared in the
// file, and names that are declared and never read. A file that cannot be parsed has {error}.
import { createRequire } from "node:module";
import { readFileSync } from "node:fs";

const { parse } = createRequire(import.meta.url)("internal/deps/acorn/acorn/dist/acorn");

// The fields of a node that hold a name of something else: of a property, of a label, of another file.
const FOREIGN = {
  MemberExpression: ["property"], Property: ["key"], MethodDefinition: ["key"], PropertyDefinition: ["key"],
  ImportSpecifier: ["imported"], ExportSpecifier: ["exported"], MetaProperty: ["meta", "property"],
  LabeledStatement: ["label"], BreakStatement: ["label"], ContinueStatement: ["label"],
};
const DECLARING = {
  VariableDeclarator: ["id"], FunctionDeclaration: ["id", "params"], FunctionExpression: ["id", "params"],
  ArrowFunctionExpression: ["params"], ClassDeclaration: ["id"], ClassExpression: ["id"], CatchClause: ["param"],
  ImportSpecifier: ["local"], ImportDefaultSpecifier: ["local"], ImportNamespaceSpecifier: ["local"],
};

function names(source) {
  const [declared, read] = [new Set(), new Set()];
  const visit = (node, declares) => {
    if (Array.isArray(node)) return node.forEach((part) => visit(part, declares));
    if (typeof node?.type !== "string") return;
    if (node.type === "Identifier") (declares ? declared : read).add(node.name);
    if (node.type.startsWith("Export") && node.declaration) {
      const made = node.declaration;
      for (const { name } of [made.id, ...(made.declarations ?? []).map(({ id }) => id)].filter(Boolean)) read.add(name);
    }
    for (const [field, value] of Object.entries(node)) {
      if (FOREIGN[node.type]?.includes(field) && !node.computed) continue;
      const pattern = declares && !(node.type === "AssignmentPattern" && field === "right");
      visit(value, pattern || DECLARING[node.type]?.includes(field));
    }
  };
  visit(parse(source, { ecmaVersion: "latest", sourceType: "module" }), false);
  const without = (all, others) => [...all].filter((name) => !others.has(name));
  return { unknown: without(read, declared), unused: without(declared, read) };
}

const checked = {};
for (const [file, source] of Object.entries(JSON.parse(readFileSync(0, "utf-8")))) {
  try {
    checked[file] = names(source);
  } catch (error) {
    checked[file] = { error: String(error) };
  }
}
console.log(JSON.stringify(checked));
