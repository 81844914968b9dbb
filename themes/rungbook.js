// What a page does beyond being read: theme, menu, the tree of libraries, filters, unfolding what a link points at.
(function () {
  "use strict";
  var body = document.body;
  var root = body.dataset.root;
  var path = body.dataset.path;

  function element(name, attributes, text) {
    var node = document.createElement(name);
    for (var key in attributes || {}) node.setAttribute(key, attributes[key]);
    if (text !== undefined) node.textContent = text;
    return node;
  }

  // --- Theme ---------------------------------------------------------------------------------------------------

  function isDark() {
    var theme = document.documentElement.dataset.theme;
    if (theme) return theme === "dark";
    return window.matchMedia("(prefers-color-scheme: dark)").matches;
  }

  function setUpTheme() {
    var button = document.querySelector("button.theme");
    if (!button) return;
    function label() {
      button.setAttribute("aria-label", isDark() ? "Use the light theme" : "Use the dark theme");
    }
    button.addEventListener("click", function () {
      var theme = isDark() ? "light" : "dark";
      document.documentElement.dataset.theme = theme;
      try {
        localStorage.setItem("rungbook-theme", theme);
      } catch (e) {
        // Not remembered, then.
      }
      label();
    });
    label();
    button.hidden = false;
  }

  // --- The menu of narrow screens ------------------------------------------------------------------------------

  function setUpMenu() {
    var menu = document.querySelector("a.menu");
    var sidebar = document.getElementById("rb-sidebar");
    if (!menu || !sidebar) return;
    menu.setAttribute("role", "button");
    menu.setAttribute("aria-controls", "rb-sidebar");
    function show(open) {
      body.classList.toggle("menu-open", open);
      menu.setAttribute("aria-expanded", String(open));
    }
    show(false);
    menu.addEventListener("click", function (event) {
      event.preventDefault();
      show(!body.classList.contains("menu-open"));
    });
    menu.addEventListener("keydown", function (event) {
      if (event.key === " ") {
        event.preventDefault();
        menu.click();
      }
    });
    document.addEventListener("keydown", function (event) {
      if (event.key === "Escape" && body.classList.contains("menu-open")) {
        show(false);
        menu.focus();
      }
    });
    document.getElementById("rb-content").addEventListener("click", function () {
      show(false);
    });
  }

  // --- The tree of libraries -----------------------------------------------------------------------------------

  // Folders by path: {name, url, entities, folders}.
  function treeOf(folders) {
    var top = { url: null, entities: [], folders: new Map() };
    folders.forEach(function (folder) {
      var node = top;
      folder[0].forEach(function (part) {
        if (!node.folders.has(part)) node.folders.set(part, { url: null, entities: [], folders: new Map() });
        node = node.folders.get(part);
      });
      node.url = folder[1];
      node.entities = folder[2];
    });
    return top;
  }

  function holdsPage(node) {
    if (node.url === path) return true;
    for (var i = 0; i < node.entities.length; i++) if (node.entities[i][1] === path) return true;
    var inner = false;
    node.folders.forEach(function (folder) {
      inner = inner || holdsPage(folder);
    });
    return inner;
  }

  // A name that breaks, where it must, before a word in it.
  function breakable(name) {
    var span = element("span");
    var words = name.replace(/_(?=.)|[a-z0-9](?=[A-Z])/g, "$&\n").split("\n");
    words.forEach(function (word, at) {
      if (at > 0) span.appendChild(element("wbr"));
      span.append(word);
    });
    return span;
  }

  function link(name, url, short) {
    var a = element("a", { href: root + url });
    if (short) a.appendChild(element("span", { class: "chip chip-" + short.toLowerCase() }, short));
    a.appendChild(breakable(name));
    if (url === path) a.setAttribute("aria-current", "page");
    return a;
  }

  // A folder's content is made when it is first opened: a large tree costs nothing until then.
  function branch(name, url, node) {
    var item = element("li");
    var head = element("div", { class: "branch" });
    var button = element("button", { type: "button", "aria-label": name, "aria-expanded": "false" });
    head.append(button, url ? link(name, url) : breakable(name));
    item.appendChild(head);
    var inside = null;
    function show(open) {
      if (!inside) {
        inside = content(node);
        item.appendChild(inside);
      }
      inside.hidden = !open;
      button.setAttribute("aria-expanded", String(open));
    }
    button.addEventListener("click", function () {
      show(button.getAttribute("aria-expanded") === "false");
    });
    if (holdsPage(node) || url === path) show(true);
    return item;
  }

  function content(node) {
    var list = element("ul");
    node.folders.forEach(function (folder, name) {
      list.appendChild(branch(name, folder.url, folder));
    });
    node.entities.forEach(function (entity) {
      var item = element("li", { class: "leaf" });
      item.appendChild(link(entity[0], entity[1], entity[2]));
      list.appendChild(item);
    });
    return list;
  }

  function setUpTree() {
    var place = document.getElementById("rb-nav-tree");
    var libraries = window.RUNGBOOK_NAV;
    if (!place || !libraries) return;
    var tree = element("ul", { class: "tree" });
    libraries.forEach(function (library) {
      tree.appendChild(branch(library[0], library[1], treeOf(library[2])));
    });
    place.replaceChildren(element("p", { class: "nav-title" }, "Libraries"), tree);
    var current = place.querySelector("[aria-current]");
    var sidebar = document.getElementById("rb-sidebar");
    if (current && sidebar) {
      var offset = current.getBoundingClientRect().top - sidebar.getBoundingClientRect().top;
      if (offset > sidebar.clientHeight * 0.7) sidebar.scrollTop = offset - sidebar.clientHeight / 3;
    }
  }

  // --- Filters -------------------------------------------------------------------------------------------------

  function setUpFilter() {
    var box = document.querySelector(".filter");
    if (!box) return;
    var rows = Array.from(document.querySelectorAll("[data-filterable] tbody tr, [data-row]"));
    var groups = Array.from(document.querySelectorAll("[data-group]"));
    var texts = null;
    var input = box.querySelector("input");
    var output = box.querySelector("output");
    input.addEventListener("input", function () {
      texts = texts || rows.map(function (row) { return row.textContent.toLowerCase(); });
      var words = input.value.toLowerCase().split(/\s+/).filter(Boolean);
      var shown = 0;
      rows.forEach(function (row, i) {
        var fits = words.every(function (word) { return texts[i].indexOf(word) >= 0; });
        row.hidden = !fits;
        if (fits) shown++;
      });
      groups.forEach(function (group) {
        group.hidden = !group.querySelector("[data-row]:not([hidden])");
      });
      output.textContent = words.length ? shown + " of " + rows.length : "";
    });
    box.hidden = false;
  }

  // --- What a link points at must not stay folded --------------------------------------------------------------

  function unfold() {
    var id;
    try {
      id = decodeURIComponent(location.hash.slice(1));
    } catch (e) {
      return;
    }
    var target = id && document.getElementById(id);
    if (!target) return;
    var folded = false;
    for (var node = target.parentElement; node; node = node.parentElement) {
      if (node.tagName === "DETAILS" && !node.open) {
        node.open = true;
        folded = true;
      }
    }
    if (folded) target.scrollIntoView();
  }

  // --- A click on the number of a line makes it the address ------------------------------------------------------

  function setUpLines() {
    document.addEventListener("click", function (event) {
      var line = event.target.closest("pre.listing a[id]");
      if (line) location.hash = line.id;
    });
  }

  // --- Stepping through a run that violates a table: table, diagram and executed lines move together ---------------

  function setUpRun(run) {
    var steps = run.querySelector(".run-steps");
    var first = Number(run.dataset.first);
    var last = Number(run.dataset.last);
    var edges = run.dataset.edges.split(" ").map(Number);
    var svg = run.querySelector(".drawing-box svg");
    var table = run.parentElement.querySelector("table.gtt");
    var cursor = null;
    if (svg) {
      cursor = document.createElementNS("http://www.w3.org/2000/svg", "rect");
      cursor.setAttribute("class", "run-cursor");
      cursor.setAttribute("y", "0");
      cursor.setAttribute("height", "100%");
      svg.appendChild(cursor);
    }
    var now = last;

    function show(cycle, move) {
      now = Math.min(last, Math.max(first, cycle));
      steps.querySelector("output").textContent = "cycle " + now + " of " + last;
      steps.querySelector("[data-step='-1']").disabled = now === first;
      steps.querySelector("[data-step='1']").disabled = now === last;
      var rows = [];
      run.querySelectorAll(".run-cycles tr[data-cycle]").forEach(function (row) {
        var current = Number(row.dataset.cycle) === now;
        row.classList.toggle("current", current);
        if (current) {
          rows = row.dataset.rows.split(", ");
          if (move) row.scrollIntoView({ block: "nearest" });
        }
      });
      run.querySelectorAll(".run-lines").forEach(function (lines) {
        lines.hidden = Number(lines.dataset.cycle) !== now;
        lines.open = !lines.hidden;
      });
      if (table) {
        table.querySelectorAll("tbody tr[data-seq]").forEach(function (row) {
          row.classList.toggle("current", rows.indexOf(row.dataset.seq) >= 0);
        });
      }
      if (cursor) {
        cursor.setAttribute("x", edges[now - first]);
        cursor.setAttribute("width", Math.max(1, edges[now - first + 1] - edges[now - first]));
      }
    }

    steps.addEventListener("click", function (event) {
      var button = event.target.closest("button[data-step]");
      if (button) show(now + Number(button.dataset.step), true);
    });
    run.addEventListener("keydown", function (event) {
      if (event.altKey || event.ctrlKey || event.metaKey) return;
      if (event.key === "ArrowLeft" || event.key === "ArrowRight") {
        show(now + (event.key === "ArrowLeft" ? -1 : 1), true);
        event.preventDefault();
      }
    });
    run.querySelector(".run-cycles").addEventListener("click", function (event) {
      var row = event.target.closest("tr[data-cycle]");
      if (row) show(Number(row.dataset.cycle), false);
    });
    steps.hidden = false;
    show(last, false);
  }

  document.querySelectorAll("section.run").forEach(setUpRun);
  setUpLines();
  setUpTheme();
  setUpMenu();
  setUpTree();
  setUpFilter();
  unfold();
  window.addEventListener("hashchange", unfold);
})();
