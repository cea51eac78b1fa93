// Prints what Signal K's parser makes of each sentence, one JSON object on a line: the values by their
// paths, or that it was refused. For tests/conformance/outputs.py. NODE_PATH names the folder where
// @signalk/nmea0183-signalk is installed.

const Parser = require("@signalk/nmea0183-signalk");

if (process.argv[2] === "--version") {
  console.log("nmea0183-signalk " + require("@signalk/nmea0183-signalk/package.json").version);
  process.exit();
}

const parser = new Parser({ emitPropertyValue() {} });

function read(sentence) {
  let delta;
  try {
    delta = parser.parse(sentence);
  } catch (error) {
    return { refused: error.message };
  }
  const values = {};
  for (const update of delta?.updates ?? []) {
    for (const { path, value } of update.values ?? []) values[path] = value;
  }
  return { values };
}

const lines = require("node:fs").readFileSync(0, "latin1").split("\n");
process.stdout.write(lines.filter((line) => line).map((line) => JSON.stringify(read(line)) + "\n").join(""));
