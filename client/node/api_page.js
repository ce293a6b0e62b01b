// api_page.js OUT: the page of the package's interface, as Markdown, made of its declarations.
import { readFileSync, writeFileSync } from "node:fs";

const source = readFileSync(new URL("src/index.d.ts", import.meta.url), "utf8");

/** The text of a comment, without its stars. */
const said = (comment) => comment.replace(/^\s*\/\*\*\s?|\s*\*\/\s*$/g, "")
  .replace(/^\s*\* ?/gm, "").trim();

let page = "# trc-client\n\nMade of `src/index.d.ts`, which editors show as well.\n";
// One with members in lines of its own ends with a brace in the first column, others in their line.
const declaration =
  /(\/\*\*(?:[^*]|\*(?!\/))*\*\/\s*)?^export (?:[^{};]*\{\n[\s\S]*?^\}|[^{};]*\{.*\}$|[^;]*;)/gm;
for (const [whole, comment] of source.matchAll(declaration)) {
  const text = whole.slice(comment?.length ?? 0);
  const name = /^export (?:interface|class|function|const) (\w+)/.exec(text)[1];
  page += `\n## ${name}\n${comment ? `\n${said(comment)}\n` : ""}\n\`\`\`ts\n${text}\n\`\`\`\n`;
}
writeFileSync(process.argv[2], page);
