// Prints what canboatjs reads in whole messages, one JSON object on a line; codes as numbers. For
// tests/conformance/n2k.py. NODE_PATH names the folder where @canboat/canboatjs is installed.
//
// Messages come on standard input as canboat writes them: time, priority, group, source, destination,
// length, bytes in hexadecimal, all with commas between.

const { FromPgn } = require("@canboat/canboatjs");

const reader = new FromPgn({ returnNulls: true, useCamel: false, resolveEnums: false });
reader.on("error", () => {});

const lines = require("node:fs").readFileSync(0, "utf8").split("\n");
for (const line of lines.filter((line) => line)) {
  const message = reader.parseString(line);
  process.stdout.write(JSON.stringify(message?.fields ?? {}) + "\n");
}
