// Pictures of pages at three widths in both themes, for the eye: `node shots.mjs FOLDER OUT [PAGE…]`.
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { launch } from "./launch.mjs";

const [folder, out, ...wanted] = process.argv.slice(2);
const pages = wanted.length ? wanted : ["index.html"];
const context = await launch();
const page = context.pages()[0] ?? (await context.newPage());
for (const colorScheme of ["light", "dark"]) {
  for (const width of [1440, 768, 390]) {
    await page.emulateMedia({ colorScheme });
    await page.setViewportSize({ width, height: 900 });
    for (const path of pages) {
      await page.goto(pathToFileURL(resolve(folder)).href + "/" + path);
      const name = path.replace(/[^\w]+/g, "-");
      await page.screenshot({ path: join(out, `${name}-${width}-${colorScheme}.png`), fullPage: true });
    }
  }
}
await context.close();
