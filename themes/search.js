// Search over an index that is loaded when it is first wanted. A script element is the one way to load data that also
// works from file://.
(function () {
  "use strict";
  var root = document.body.dataset.root;
  var input = document.getElementById("rb-search");
  var page = document.getElementById("rb-search-page");
  if (!input) return;

  var SHOWN = 12;
  var SHOWN_ON_PAGE = 200;
  var entries = null;
  var waiting = [];
  var loading = false;

  // --- The index -----------------------------------------------------------------------------------------------

  function load(then) {
    if (entries) return then();
    waiting.push(then);
    if (loading) return;
    loading = true;
    var script = document.createElement("script");
    script.src = root + "assets/search-index.js";
    script.onload = function () {
      prepare(window.RUNGBOOK_INDEX || { kinds: [], contexts: [], entries: [] });
      waiting.splice(0).forEach(function (callback) { callback(); });
    };
    document.head.appendChild(script);
  }

  function prepare(index) {
    entries = index.entries.map(function (entry) {
      var context = index.contexts[entry[2]];
      return {
        name: entry[0],
        kind: index.kinds[entry[1]],
        context: context,
        url: entry[3],
        brief: entry[4] || "",
        lower: entry[0].toLowerCase(),
        where: context.toLowerCase(),
        text: (entry[4] || "").toLowerCase(),
      };
    });
  }

  // --- Ranking: the name itself, its beginning, the beginning of a word in it, inside it, its owner, its brief ----

  function startsWord(entry, at) {
    var before = entry.name[at - 1];
    var here = entry.name[at];
    return before === "_" || before === "." || (before === before.toLowerCase() && here !== here.toLowerCase());
  }

  function rankOf(entry, word) {
    var at = entry.lower.indexOf(word);
    if (at === 0) return entry.lower.length === word.length ? 0 : 1;
    if (at > 0) return startsWord(entry, at) ? 2 : 3;
    if (entry.where.indexOf(word) >= 0) return 4;
    if (entry.text.indexOf(word) >= 0) return 5;
    return -1;
  }

  function find(query, limit) {
    var words = query.toLowerCase().split(/[\s.]+/).filter(Boolean);
    if (!words.length) return [];
    var hits = [];
    for (var i = 0; i < entries.length; i++) {
      var rank = 0;
      for (var w = 0; w < words.length && rank >= 0; w++) {
        var one = rankOf(entries[i], words[w]);
        rank = one < 0 ? -1 : rank + one;
      }
      if (rank >= 0) hits.push({ entry: entries[i], rank: rank, order: i });
    }
    hits.sort(function (a, b) {
      return a.rank - b.rank || a.entry.name.length - b.entry.name.length || a.order - b.order;
    });
    return { total: hits.length, entries: hits.slice(0, limit).map(function (hit) { return hit.entry; }) };
  }

  // --- Showing ---------------------------------------------------------------------------------------------------

  function span(className, text) {
    var node = document.createElement("span");
    node.className = className;
    node.textContent = text;
    return node;
  }

  // The first word of the query in the name, marked.
  function marked(name, query) {
    var node = span("hit-name", "");
    var word = query.toLowerCase().split(/[\s.]+/).filter(Boolean)[0] || "";
    var at = name.toLowerCase().indexOf(word);
    if (at < 0) {
      node.textContent = name;
      return node;
    }
    var mark = document.createElement("mark");
    mark.textContent = name.slice(at, at + word.length);
    node.append(name.slice(0, at), mark, name.slice(at + word.length));
    return node;
  }

  function hit(entry, query) {
    var link = document.createElement("a");
    link.className = "hit";
    link.href = root + entry.url;
    var where = entry.context ? entry.kind + ", " + entry.context : entry.kind;
    link.append(marked(entry.name, query), " ", span("hit-where", where));
    if (entry.brief) link.append(span("hit-brief", entry.brief));
    return link;
  }

  // --- The list under the field: a combobox after the ARIA practices -----------------------------------------------

  var list = document.createElement("div");
  list.id = "rb-search-list";
  list.className = "search-list";
  list.setAttribute("role", "listbox");
  list.setAttribute("aria-label", "Search results");
  list.hidden = true;
  input.form.appendChild(list);
  input.setAttribute("role", "combobox");
  input.setAttribute("aria-autocomplete", "list");
  input.setAttribute("aria-controls", "rb-search-list");
  input.setAttribute("aria-expanded", "false");
  var status = span("vh", "");
  status.setAttribute("role", "status");
  input.form.appendChild(status);
  var chosen = -1;

  function open(yes) {
    list.hidden = !yes;
    input.setAttribute("aria-expanded", String(yes));
    if (!yes) choose(-1);
  }

  function choose(index) {
    var options = list.querySelectorAll("[role=option]");
    if (chosen >= 0 && options[chosen]) options[chosen].setAttribute("aria-selected", "false");
    chosen = options.length ? Math.max(-1, Math.min(index, options.length - 1)) : -1;
    if (chosen < 0) {
      input.removeAttribute("aria-activedescendant");
      return;
    }
    options[chosen].setAttribute("aria-selected", "true");
    options[chosen].scrollIntoView({ block: "nearest" });
    input.setAttribute("aria-activedescendant", options[chosen].id);
  }

  function show() {
    var query = input.value.trim();
    if (!query) return open(false);
    load(function () {
      if (input.value.trim() !== query) return;
      var found = find(query, SHOWN);
      if (!found.entries) return open(false);
      list.replaceChildren();
      found.entries.forEach(function (entry, i) {
        var option = hit(entry, query);
        option.id = "rb-search-option-" + i;
        option.setAttribute("role", "option");
        option.setAttribute("aria-selected", "false");
        option.tabIndex = -1;
        list.appendChild(option);
      });
      status.textContent = found.total ? found.total + " results" : "No results";
      if (!found.total) list.appendChild(nothing());
      open(true);
      choose(found.total ? 0 : -1);
    });
  }

  function nothing() {
    var node = document.createElement("div");
    node.className = "no-hit";
    node.setAttribute("role", "option");
    node.setAttribute("aria-disabled", "true");
    node.setAttribute("aria-selected", "false");
    node.textContent = "No results";
    return node;
  }

  input.addEventListener("focus", function () {
    load(function () {});
    if (input.value) show();
  });
  input.addEventListener("input", show);
  input.addEventListener("keydown", function (event) {
    if (event.key === "ArrowDown" || event.key === "ArrowUp") {
      event.preventDefault();
      if (list.hidden) show();
      else choose(chosen + (event.key === "ArrowDown" ? 1 : -1));
    } else if (event.key === "Escape") {
      if (list.hidden) input.blur();
      else open(false);
      event.preventDefault();
    } else if (event.key === "Enter" && !list.hidden && chosen >= 0) {
      var option = list.querySelectorAll("a[role=option]")[chosen];
      if (!option) return;
      event.preventDefault();
      open(false);
      option.click();
    }
  });
  document.addEventListener("click", function (event) {
    if (!input.form.contains(event.target)) open(false);
  });
  document.addEventListener("keydown", function (event) {
    var typing = /^(input|textarea|select)$/i.test(event.target.tagName) || event.target.isContentEditable;
    if (event.key === "/" && !typing && !event.ctrlKey && !event.metaKey && !event.altKey) {
      event.preventDefault();
      input.focus();
      input.select();
    }
  });

  // --- The page of results -----------------------------------------------------------------------------------------

  function showPage() {
    var query = new URLSearchParams(location.search).get("q") || "";
    input.value = query;
    if (!query.trim()) {
      page.textContent = "Type what you look for in the field above.";
      return;
    }
    load(function () {
      var found = find(query, SHOWN_ON_PAGE);
      var total = found.total || 0;
      var title = document.createElement("p");
      title.className = "meta";
      title.textContent = total + (total === 1 ? " result for " : " results for ") + "“" + query + "”";
      page.replaceChildren(title);
      (found.entries || []).forEach(function (entry) { page.appendChild(hit(entry, query)); });
      if (total > SHOWN_ON_PAGE) page.appendChild(span("muted", "The first " + SHOWN_ON_PAGE + " are shown."));
    });
  }
  if (page) showPage();
})();
