// SPDX-License-Identifier: MIT
// Writes the reference of the package for JavaScript from its declarations, for the JavaScript domain of Sphinx: each
// declaration as it is written, then its comment. Everything exported becomes an entry of its own.
//
//   javascript.mjs DECLARATIONS.d.ts OUTPUT
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname } from 'node:path';
import { fileURLToPath } from 'node:url';

const viewer = fileURLToPath(new URL('../../viewer/package.json', import.meta.url));
const ts = createRequire(viewer)('typescript');
const [declarations, output] = process.argv.slice(2);
const source = ts.createSourceFile(declarations, readFileSync(declarations, 'utf8'), ts.ScriptTarget.Latest, true);

const GROUPS = [
  ['Functions', ts.SyntaxKind.FunctionDeclaration, 'function'],
  ['Classes', ts.SyntaxKind.ClassDeclaration, 'class'],
  ['Options and results', ts.SyntaxKind.InterfaceDeclaration, 'class'],
  ['Types', ts.SyntaxKind.TypeAliasDeclaration, 'data'],
  ['Constants', ts.SyntaxKind.VariableStatement, 'data'],
];

const isCallable = (node) =>
  ts.isMethodDeclaration(node) || ts.isMethodSignature(node) || ts.isFunctionDeclaration(node);
const isExported = (node) => node.modifiers?.some(({ kind }) => kind === ts.SyntaxKind.ExportKeyword);
const declared = (node) => (ts.isVariableStatement(node) ? node.declarationList.declarations[0] : node);
const nameOf = (node) => (ts.isConstructorDeclaration(node) ? 'constructor' : declared(node).name.getText());
const membersOf = (node) => (ts.isClassDeclaration(node) || ts.isInterfaceDeclaration(node) ? node.members : []);

function title(node) {
  if (!isCallable(node) && !ts.isConstructorDeclaration(node)) return nameOf(node);
  return `${nameOf(node)}(${node.parameters.map(({ name }) => name.getText()).join(', ')})`;
}

// The declaration without comments and bodies, with the indentation of its first line removed from all.
function declaration(node) {
  const text = node.getText().replace(/^export (declare )?/, '');
  const indent = ' '.repeat(source.getLineAndCharacterOfPosition(node.getStart()).character);
  const lines = text.replace(/\/\*\*[\s\S]*?\*\/\s*/g, '').split('\n').filter((line) => line.trim());
  return lines.map((line) => (line.startsWith(indent) ? line.slice(indent.length) : line)).join('\n');
}

function comment(node) {
  const docs = node.jsDoc?.at(-1);
  if (docs === undefined) return '';
  const parts = [ts.getTextOfJSDocComment(docs.comment) ?? ''];
  const tags = (docs.tags ?? []).map((tag) => {
    const text = (ts.getTextOfJSDocComment(tag.comment) ?? '').replace(/\s*\n\s*/g, ' ');
    return ts.isJSDocParameterTag(tag) ? `:param ${tag.name.getText()}: ${text}` : `:throws: ${text}`;
  });
  if (tags.length > 0) parts.push(tags.join('\n'));
  return fenced(parts.join('\n\n').trim());
}

// Comments contain examples as indented blocks; a fence of their own keeps their language.
function fenced(text) {
  const fence = '```';
  return text.replace(/(?:^ {4}.*\n?)+/gm, (code) => `${fence}js\n${code.replace(/^ {4}/gm, '').trimEnd()}\n${fence}\n`);
}

function block(directive, heading, body, fence) {
  return `${fence}{js:${directive}} ${heading}\n\n${body.trim()}\n${fence}\n`;
}

function code(nodes) {
  return `\`\`\`ts\n${nodes.map(declaration).join('\n')}\n\`\`\`\n`;
}

// The overloads of a name are one entry, under the first.
function grouped(nodes) {
  const groups = new Map();
  for (const node of nodes) groups.set(nameOf(node), [...(groups.get(nameOf(node)) ?? []), node]);
  return [...groups.values()];
}

function member(nodes) {
  const [first] = nodes;
  const directive = isCallable(first) || ts.isConstructorDeclaration(first) ? 'method' : 'attribute';
  return block(directive, title(first), `${code(nodes)}\n${nodes.map(comment).join('\n\n')}`, '::::');
}

function entry(nodes, directive) {
  const [first] = nodes;
  const named = membersOf(first).filter((part) => part.name !== undefined || ts.isConstructorDeclaration(part));
  const own = named.length > 0 ? '' : code(nodes);
  const parts = [own, ...nodes.map(comment), ...grouped(named).map(member)];
  return block(directive, title(first), parts.join('\n\n'), ':::::');
}

const exported = source.statements.filter(isExported);
const pages = GROUPS.map(([heading, kind, directive]) => {
  const nodes = exported.filter((node) => node.kind === kind);
  return `## ${heading}\n\n${grouped(nodes).map((group) => entry(group, directive)).join('\n')}`;
});
const left = exported.filter(({ kind }) => !GROUPS.some((group) => group[1] === kind));
if (left.length > 0) throw new Error(`${declarations}: no group for ${left.map(nameOf).join(', ')}`);

mkdirSync(dirname(output), { recursive: true });
writeFileSync(output, pages.join('\n'));
