// Drives a rendered site from file:// and says what is wrong: `node site.mjs FOLDER`. Each check is a line; the exit
// code is 1 if one failed.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { launch } from "./launch.mjs";

const root = resolve(process.argv[2]);
const url = (path) => pathToFileURL(root).href + "/" + path;
const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
const ENTITY = "handling/drives/fb_cylinder.html";
const PAGES = [
  "index.html", ENTITY, "handling/base/fb_actuator.html", "handling/types/e_cylinderstate.html", "handling/index.html",
  "handling/hostile.html", "handling/folder-drives.html", "function-blocks.html", "names.html", "coverage.html",
  "findings.html", "files.html", "search.html?q=cylinder", "chapters/getting-started.html",
];

const context = await launch({ viewport: { width: 1440, height: 900 } });
const page = context.pages()[0] ?? (await context.newPage());
let failed = 0;
let complaints = [];
context.on("console", (message) => {
  if (message.type() === "error" || message.type() === "warning") complaints.push(message.text());
});
context.on("weberror", (error) => complaints.push(String(error.error())));
context.on("dialog", (dialog) => {
  complaints.push(`a dialog: ${dialog.message()}`);
  dialog.dismiss();
});
context.on("request", (request) => {
  if (!/^(file|data|about):/.test(request.url())) complaints.push(`asked for ${request.url()}`);
});

async function check(name, run) {
  complaints = [];
  try {
    await run();
    if (complaints.length) throw new Error(complaints.join("; "));
    console.log(`ok      ${name}`);
  } catch (error) {
    failed++;
    console.log(`FAILED  ${name}: ${error.message}`);
  }
}

function equal(actual, expected, what) {
  if (actual !== expected) throw new Error(`${what}: ${JSON.stringify(actual)} instead of ${JSON.stringify(expected)}`);
}

const here = () => decodeURI(page.url().slice(url("").length));

await check("search by keyboard finds a block and opens it", async () => {
  await page.goto(url("index.html"));
  await page.keyboard.press("/");
  equal(await page.evaluate(() => document.activeElement.id), "rb-search", "focus");
  await page.keyboard.type("cyl");
  await page.waitForSelector("#rb-search-list [role=option]");
  equal(await page.locator("#rb-search-list [role=option] .hit-name").first().textContent(), "FB_Cylinder", "first hit");
  equal(await page.getAttribute("#rb-search", "aria-activedescendant"), "rb-search-option-0", "chosen");
  await page.keyboard.press("ArrowDown");
  equal(await page.getAttribute("#rb-search", "aria-activedescendant"), "rb-search-option-1", "chosen after an arrow");
  await page.keyboard.press("ArrowUp");
  await page.keyboard.press("Enter");
  await page.waitForURL(url(ENTITY));
  equal(await page.textContent("h1"), "FB_Cylinder", "title");
});

await check("search finds a member and goes to its anchor", async () => {
  await page.goto(url(ENTITY));
  await page.keyboard.press("/");
  await page.keyboard.type("cylinder.retr");
  await page.waitForSelector("#rb-search-list [role=option]");
  await page.keyboard.press("Enter");
  await page.waitForURL(url(ENTITY) + "#m-retract");
  const top = await page.evaluate(() => document.getElementById("m-retract").getBoundingClientRect().top);
  if (top < 40 || top > 400) throw new Error(`the member is at ${top}`);
});

await check("search says when it finds nothing, and Escape closes it", async () => {
  await page.goto(url("index.html"));
  await page.focus("#rb-search");
  await page.keyboard.type("zzzzz");
  await page.waitForSelector(".no-hit");
  await page.keyboard.press("Escape");
  equal(await page.isHidden("#rb-search-list"), true, "the list is hidden");
});

await check("a hostile name is found and shown as text", async () => {
  await page.goto(url("search.html?q=" + encodeURIComponent("</script>")));
  await page.waitForSelector("#rb-search-page .hit");
  await page.click("#rb-search-page .hit");
  equal((await page.textContent("h1")).startsWith("</script><script>"), true, "the name is text");
});

await check("the theme is toggled and remembered", async () => {
  await page.goto(url("index.html"));
  const paper = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await paper();
  await page.click("button.theme");
  const dark = await paper();
  if (light === dark) throw new Error("the theme did not change");
  await page.goto(url(ENTITY));
  equal(await paper(), dark, "the theme on another page");
  await page.click("button.theme");
  equal(await paper(), light, "the theme toggled back");
});

await check("the tree shows the page in its folder", async () => {
  await page.goto(url(ENTITY));
  equal(await page.textContent("#rb-nav-tree a[aria-current]"), "FBFB_Cylinder", "current entry");
  await page.click("#rb-nav-tree button[aria-label='Types']");
  await page.click("#rb-nav-tree a:has-text('E_CylinderState')");
  await page.waitForURL(url("handling/types/e_cylinderstate.html"));
});

await check("a link to a line unfolds its listing", async () => {
  await page.goto(url(ENTITY));
  await page.click(".entity-head .place");
  await page.waitForFunction(() => document.getElementById("s0-L3").closest("details").open);
  await page.goto(url(ENTITY + "#s1-L62"));
  await page.waitForFunction(() => document.getElementById("s1-L62").closest("details").open);
});

await check("lines are numbered as in the file, and a click makes one the address", async () => {
  await page.goto(url(ENTITY + "#s1-L62"));
  const reset = await page.evaluate(() => document.getElementById("s1-L62").parentElement.style.counterReset);
  equal(reset, "line 59", "the count begins before the first line");
  await page.click("#s1-L64");
  equal(here(), ENTITY + "#s1-L64", "address");
});

await check("findings are filtered", async () => {
  await page.goto(url("findings.html"));
  await page.fill(".filter input", "bError");
  equal(await page.locator("[data-row]:visible").count(), 1, "rows shown");
  await page.fill(".filter input", "");
  equal(await page.locator("[data-row]:visible").count(), 3, "rows shown again");
});

await check("brackets stand beside their rows", async () => {
  await page.goto(url(ENTITY));
  const boxes = await page.evaluate(() => {
    const box = (node) => { const r = node.getBoundingClientRect(); return [r.top, r.bottom, r.left]; };
    const table = document.querySelector("#t-travel table");
    return { rows: [...table.querySelectorAll("tbody tr")].map(box), brackets: [...table.querySelectorAll(".bracket")].map(box) };
  });
  const near = (a, b) => Math.abs(a - b) < 3;
  const spans = (b, first, last) => near(b[0], boxes.rows[first][0]) && near(b[1], boxes.rows[last][1]);
  const inner = boxes.brackets.find((b) => spans(b, 1, 2));
  const outer = boxes.brackets.find((b) => spans(b, 0, 3));
  if (!inner || !outer || inner[2] >= outer[2]) throw new Error(JSON.stringify(boxes));
});

await check("the page is read without JavaScript", async () => {
  const plain = await launch({ javaScriptEnabled: false, viewport: { width: 390, height: 844 } });
  try {
    const quiet = plain.pages()[0] ?? (await plain.newPage());
    await quiet.goto(url(ENTITY));
    equal(await quiet.isVisible("button.theme"), false, "the toggle is hidden");
    await quiet.click("a.menu");
    await quiet.click(".sidebar a:has-text('Function blocks')");
    equal(await quiet.textContent("h1"), "Function blocks", "title");
  } finally {
    await plain.close();
  }
});

await check("the menu opens on a phone", async () => {
  await page.setViewportSize({ width: 390, height: 844 });
  await page.goto(url(ENTITY));
  equal(await page.isVisible("#rb-sidebar"), false, "the menu is closed");
  await page.click("a.menu");
  equal(await page.isVisible("#rb-sidebar"), true, "the menu is open");
  await page.keyboard.press("Escape");
  equal(await page.isVisible("#rb-sidebar"), false, "the menu is closed again");
});

// The elements that reach beyond the window and stand in no box that scrolls.
const widest = () =>
  [...document.querySelectorAll("body *")]
    .filter((node) => node.getBoundingClientRect().right > document.documentElement.clientWidth + 1)
    .filter((node) => !node.parentElement.closest(".scroll, .drawing-box, pre"))
    .slice(0, 5)
    .map((node) => node.outerHTML.slice(0, 120))
    .join(" | ");

for (const width of [390, 768, 1440]) {
  await check(`no page is wider than ${width} px`, async () => {
    await page.setViewportSize({ width, height: 900 });
    for (const path of PAGES) {
      await page.goto(url(path));
      await page.evaluate(() => document.querySelectorAll("details").forEach((d) => (d.open = true)));
      const over = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
      if (over > 0) throw new Error(`${path} is ${over} px too wide: ${await page.evaluate(widest)}`);
    }
  });
}

for (const [colorScheme, width] of [["light", 1440], ["dark", 390]]) {
  await check(`axe finds nothing serious, ${colorScheme}, ${width} px`, async () => {
    await page.emulateMedia({ colorScheme });
    await page.setViewportSize({ width, height: 900 });
    for (const path of PAGES) {
      await page.goto(url(path));
      await page.evaluate(() => document.querySelectorAll("details").forEach((d) => (d.open = true)));
      await page.evaluate(axe);
      const { violations } = await page.evaluate(() => window.axe.run(document, { preload: false }));
      const serious = violations.filter((v) => v.impact === "serious" || v.impact === "critical");
      const node = (n) => `${n.html.slice(0, 160)} ${n.any[0]?.message ?? ""}`;
      const lines = serious.map((v) => `${v.id}: ${v.nodes.slice(0, 3).map(node).join(" | ")}`);
      if (lines.length) throw new Error(`${path}: ${lines.join("; ")}`);
    }
  });
}

await check("following every link of the front page gives a page", async () => {
  await page.goto(url("index.html"));
  const links = await page.$$eval("a[href]", (all) => [...new Set(all.map((a) => a.href.split("#")[0]))]);
  for (const link of links) {
    await page.goto(link);
    if (!(await page.textContent("h1")).trim()) throw new Error(`${link} has no title`);
  }
});

await context.close();
process.exit(failed ? 1 : 0);
