// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Prints Khronos' report on each glTF file named, as a JSON list.
import { readFileSync } from "node:fs";
import validator from "gltf-validator";

const reports = [];
for (const path of process.argv.slice(2)) {
  reports.push(await validator.validateBytes(new Uint8Array(readFileSync(path)), { uri: path, maxIssues: 1000 }));
}
console.log(JSON.stringify(reports));
