// Sigstore's own library reads a bundle and checks its signature by a key of ours: node sigstore.mjs BUNDLE KEY.pem
import { createHash, createPublicKey } from "node:crypto";
import { readFileSync } from "node:fs";
import { bundleFromJSON } from "@sigstore/bundle";
import { toSignedEntity, toTrustMaterial, Verifier } from "@sigstore/verify";

const [file, pem] = process.argv.slice(2);
const bundle = bundleFromJSON(JSON.parse(readFileSync(file, "utf8")));
const key = createPublicKey(readFileSync(pem));
const hint = createHash("sha256").update(key.export({ type: "spki", format: "der" })).digest("base64");
const services = { certificateAuthorities: [], timestampAuthorities: [], tlogs: [], ctlogs: [] };
const trust = toTrustMaterial(services, (named) => {
  if (named !== hint) throw new Error(`the bundle names another key: ${named}`);
  return { publicKey: key, validFor: () => true };
});
// The evidence was made offline: no log and no authority has seen it.
new Verifier(trust, { tlogThreshold: 0, ctlogThreshold: 0, timestampThreshold: 0 }).verify(toSignedEntity(bundle));
