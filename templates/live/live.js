/* The live page: what the program tells of the machine is shown, what is changed here is sent. Texts are written as texts, never as markup. */
(function () {
  "use strict";
  var MARKS = { pass: "✓", warn: "!", fail: "✗", error: "✗", skipped: "–", not_checked: "?", conditional: "?" };
  var WORDS = JSON.parse(document.body.dataset.words);
  var byId = function (id) { return document.getElementById(id); };
  var PAUSE = 250;  /* milliseconds */
  var MOST = 60;  /* inputs that a search shows */
  var state = null, open = null, chosen = null, effect = null, sending = false, waiting = {}, stroke = "", flying = {}, shownFigures = {}, isLost = false;

  var FIGURES = new Intl.NumberFormat(document.documentElement.lang, { maximumSignificantDigits: 6 });

  /* A text of the page in its language, its places filled. */
  function t(name, values) { return WORDS[name].replace(/\{(\w+)\}/g, function (place, key) { return String(values[key]); }); }

  function make(name, attributes, children) {
    var node = document.createElement(name);
    Object.keys(attributes || {}).forEach(function (key) { node.setAttribute(key, attributes[key]); });
    [].concat(children === undefined ? [] : children).forEach(function (child) { node.append(child); });
    return node;
  }

  function drawn(name, attributes) {
    var node = document.createElementNS("http://www.w3.org/2000/svg", name);
    Object.keys(attributes).forEach(function (key) { node.setAttribute(key, attributes[key]); });
    return node;
  }

  function sign(symbol) {
    var parts = symbol.split("_"), base = make("i", { "class": "sy" }, parts[0]);
    return parts.length > 1 ? [base, make("sub", {}, parts.slice(1).join(" "))] : [base];
  }

  /* What became of an act; what was refused stands until it, or the file, is another. */
  var saidAt = null;
  function say(text, isGood) {
    byId("told").textContent = text || "";
    byId("told").className = isGood ? "good" : "";
    saidAt = text && !isGood && state ? state.serial : null;
  }

  function mark(status) { return make("span", { "class": "mark s-" + status }, MARKS[status] || "·"); }

  /* A number in the form of the page's language. */
  function told(number, digits) {
    return number.toLocaleString(document.documentElement.lang, { minimumFractionDigits: digits, maximumFractionDigits: digits, useGrouping: false });
  }

  /* So many digits that what is beyond its limit does not look as if it were at it. */
  function percent(ratio) {
    if (ratio === null || ratio === undefined) { return "–"; }
    var digits = ratio < 0.0995 ? 1 : 0;
    while (digits < 4 && ratio !== 1 && Math.abs(ratio - 1) > 1e-9 && (100 * ratio).toFixed(digits) === (100).toFixed(digits)) { digits += 1; }
    return told(100 * ratio, digits) + " %";
  }

  /* ---- talking to the program ---- */
  function post(path, body) {
    return fetch(path, { method: "POST", headers: { "Content-Type": "application/json" }, body: JSON.stringify(body || {}) }).then(function (answer) {
      if (answer.status === 422) { return answer.json().then(function (told) { throw told; }); }
      if (!answer.ok) { throw { refused: t("refused", { status: answer.status }) }; }
      say("");
      return answer.json();
    });
  }

  function failed(fault) { say(fault.refused || t("no_answer")); }

  /* One request at a time: what is moved meanwhile is sent with the next. */
  function send() {
    if (sending || !Object.keys(waiting).length) { return; }
    busy();
    var changes = flying = waiting;
    sending = true;
    waiting = {};
    var answered = 0;
    post("change", { changes: changes, stroke: stroke }).then(function (told) { answered = told.serial; wrong(changes, ""); }, function (fault) {
      failed(fault);
      wrong(changes, fault.refused || "");
    }).then(function () {
      sending = false;
      flying = {};
      ready();
      if (state.machine && state.serial >= answered) { inputs(); }  /* the state has come before the answer */
      send();
    });
  }

  /* What takes longer than a moment is said. */
  var isBusy = 0;
  function busy() { clearTimeout(isBusy); isBusy = setTimeout(function () { byId("busy").hidden = false; }, 150); }
  function ready() { clearTimeout(isBusy); byId("busy").hidden = true; }

  function act(path, body) {
    busy();
    return post(path, body).then(function () { return true; }, function (fault) { failed(fault); return false; }).then(function (isDone) { ready(); return isDone; });
  }

  /* A slider's way from where it is taken to where it is let go is one step for undo. */
  var strokes = 0, tab = Math.random().toString(36);
  function change(name, typed, isMoving) {
    waiting[name] = typed;
    stroke = [tab, name, strokes].join(" ");
    if (!isMoving) { strokes += 1; }
    send();
  }

  function wrong(changes, text) {
    Object.keys(changes).forEach(function (name) {
      var row = document.querySelector('.input[data-name="' + CSS.escape(name) + '"]');
      if (row) {
        row.querySelector(".wrong").textContent = text;
        row.querySelector(".typed").setAttribute("aria-invalid", String(Boolean(text)));
      }
    });
  }

  /* ---- what is told ---- */
  function verdict() {
    var machine = state.machine, summary = machine && machine.summary;
    var shown = state.faults.length || machine.status === "error" ? "error" : summary.verdict;
    var line = byId("verdict"), words = t("verdict_fault");
    line.querySelector(".mark").className = "mark s-" + shown;
    line.querySelector(".mark").textContent = MARKS[shown];
    if (!state.faults.length) {
      words = machine.conclusion + " " + t("count_pass", { n: summary.pass });
      if (summary.governing) { words += "; " + t("governing", { check: summary.governing }); }
      if (machine.start.summary.fail !== summary.fail) { words += " (" + t("failed_before", { n: machine.start.summary.fail }) + ")"; }
    }
    line.querySelector(".words").textContent = words;
    document.body.classList.toggle("stale-state", state.faults.length > 0);
    var count = Object.keys(state.edits).length;
    byId("write").disabled = byId("back").disabled = !count;
    byId("undo").disabled = !state.can.undo;
    byId("redo").disabled = !state.can.redo;
    byId("write").textContent = count ? t("write_n", { n: count }) : t("write");
    document.title = (MARKS[shown] || "") + " " + state.file;
    byId("title").textContent = machine ? machine.title : state.file;
  }

  function faults() {
    var box = byId("faults"), list = box.querySelector("ol");
    box.hidden = !state.faults.length;
    box.querySelector(".stale").hidden = !state.machine;
    list.replaceChildren.apply(list, state.faults.map(function (fault) {
      var place = fault.line ? state.file + ":" + fault.line + (fault.column ? ":" + fault.column : "") + " " : "";
      return make("li", {}, [make("span", { "class": "place" }, place), fault.path ? fault.path + ": " : "", fault.text]);
    }));
    if (state.more_faults) { list.append(make("li", {}, t("more_faults", { n: state.more_faults }))); }
  }

  function worst(mechanism) {
    var order = ["fail", "warn", "pass"];
    if (mechanism.skipped) { return "skipped"; }
    return order.find(function (status) { return mechanism.checks.some(function (check) { return check.status === status; }); }) || "not_checked";
  }

  function mechanisms() {
    var all = state.machine.mechanisms;
    if (!all.some(function (each) { return each.name === open; })) {
      var failing = all.find(function (each) { return each.checks.some(function (check) { return check.status === "fail"; }); });
      open = (failing || all[1] || all[0]).name;
    }
    var held = document.activeElement && document.activeElement.dataset.mechanism;
    byId("mechanisms").replaceChildren.apply(byId("mechanisms"), all.map(function (each) {
      var button = make("button", { type: "button", "data-mechanism": each.name, title: each.title }, [each.checks.length ? mark(worst(each)) : make("span", { "class": "mark" }, ""), " " + each.name]);
      if (each.name === open) { button.setAttribute("aria-current", "true"); }
      button.addEventListener("click", function () { visit(each.name); });
      return button;
    }));
    if (held) { var again = document.querySelector('[data-mechanism="' + CSS.escape(held) + '"]'); if (again) { again.focus(); } }
  }

  function visit(name) {
    open = name;
    chosen = effect = null;
    byId("search").value = "";
    show();
    askEffect();
    askAdvice();
  }

  function current() { return state.machine.mechanisms.find(function (each) { return each.name === open; }); }

  /* The press stands first; other mechanisms may have no checks either. */
  function onPress() { return current() === state.machine.mechanisms[0]; }

  function isUnmet(check) { return check.status === "fail" || check.status === "warn"; }

  /* ---- inputs: rows are kept while a hand is on them ---- */
  function inputs() {
    var rows = byId("inputs").querySelector(".rows"), own = found(), names = own.map(function (each) { return each.name + (each.value === null); });
    var there = Array.from(rows.children).map(function (row) { return row.dataset.name + row.dataset.isWord; });
    if (there.join() !== names.join()) {
      rows.replaceChildren.apply(rows, own.map(inputRow));
    }
    own.forEach(function (each, index) { fill(rows.children[index], each, each.is_default && !(index && own[index - 1].is_default)); });
    if (!own.length) { rows.replaceChildren(make("p", { "class": "hint" }, sought() ? t("not_found") : t("no_inputs"))); }
  }

  function sought() { return byId("search").value.trim().toLowerCase(); }

  function everyInput() { return [].concat.apply([], state.machine.mechanisms.map(function (each) { return each.inputs; })); }

  /* The inputs of the mechanism that is shown, or all in whose key, words or sign each word stands that is searched for. */
  function found() {
    var words = sought().split(/\s+/);
    if (!sought()) { return current().inputs; }
    var seen = {};  /* what several mechanisms are made of stands at each */
    return everyInput().filter(function (each) {
      if (seen[each.name]) { return false; }
      seen[each.name] = true;
      var text = (each.name + " " + each.text + " " + each.symbol).toLowerCase();
      return words.every(function (word) { return text.indexOf(word) >= 0; });
    }).slice(0, MOST);
  }

  function inputRow(each) {
    var id = "in-" + each.name.replace(/\W/g, "-");
    var slider = each.options || each.value === null ? null : make("input", { type: "range", "aria-label": t("slider", { input: each.text }) });
    var typed = each.options ? make("select", { id: id, "class": "typed" }) : make("input", { type: "text", id: id, "class": "typed", autocomplete: "off", spellcheck: "false", maxlength: "100" });
    var back = make("button", { type: "button", title: t("take_back"), "aria-label": t("take_back_of", { input: each.text }) }, "↺");
    var row = make("div", { "class": "input", "data-name": each.name, "data-is-word": each.value === null }, [
      make("label", { "for": id }, [each.text + " "].concat(each.symbol ? sign(each.symbol) : [])), make("div", { "class": "key" }, sought() ? each.name : key(each)),
      make("div", { "class": "line" }, [slider || "", typed, back]), make("div", { "class": "was" }), make("div", { "class": "wrong", role: "alert" }), make("div", { "class": "fault" })]);
    if (slider) { slider.addEventListener("input", function () { typed.value = slider.value + (row.unit ? " " + row.unit : ""); change(each.name, typed.value, true); }); slider.addEventListener("change", function () { strokes += 1; }); }
    typed.addEventListener("change", function () { row.sent = typed.value; change(each.name, typed.value); });
    typed.addEventListener("keydown", function (event) { if (event.key === "Escape" && !each.options) { typed.value = row.typed; wrong(Object.fromEntries([[each.name, ""]]), ""); } });
    back.addEventListener("click", function () { delete waiting[each.name]; act("back", { names: [each.name] }); });
    if (slider) { [slider, typed].forEach(function (field) { field.addEventListener("focus", function () { choose(each.name); }); }); }
    return row;
  }

  /* What an input is called in the block of its mechanism in the file. */
  function key(each) { return each.name.slice(each.name.indexOf(".") + 1); }

  /* The values that an input may have, and what stands in the file. */
  function options(select, each) {
    var values = each.options.indexOf(each.typed) < 0 ? [each.typed].concat(each.options) : each.options;
    if (select.dataset.values !== values.join("\n")) {
      select.dataset.values = values.join("\n");
      select.replaceChildren.apply(select, values.map(function (value) { return make("option", { value: value }, value); }));
    }
  }

  function fill(row, each, isFirstDefault) {
    var slider = row.querySelector("input[type=range]"), typed = row.querySelector(".typed"), isEdited = each.name in state.edits;
    row.unit = each.unit;
    row.typed = each.typed;
    if (each.options) { options(typed, each); }
    if (slider && document.activeElement !== slider) {
      var low = Math.min(each.low, each.value), high = Math.max(each.high, each.value);
      var step = each.whole ? 1 : round((high - low) / 200);
      slider.step = step;
      slider.min = (Math.ceil(low / step - 1e-9) * step).toPrecision(12);
      slider.max = (Math.floor(high / step + 1e-9) * step).toPrecision(12);
      slider.value = each.value;
    }
    var isHeld = document.activeElement === typed && typed.value !== row.sent, isOnItsWay = each.name in waiting || each.name in flying;
    if (!isHeld && !isOnItsWay && typed.getAttribute("aria-invalid") !== "true") { typed.value = row.sent = each.typed; }
    row.querySelector(".fault").textContent = state.faults.filter(function (fault) { return isEdited && (fault.path === each.path || fault.path === each.path + ".value"); }).map(function (fault) { return fault.text; }).join(" ");
    row.classList.toggle("edited", isEdited);
    row.dataset.heading = isFirstDefault ? t("at_default") : "";
    row.classList.toggle("chosen", each.name === chosen);
    row.querySelector("button").hidden = !isEdited;
    row.querySelector(".was").textContent = each.start && each.start !== each.typed ? t("before", { value: each.start }) : "";
  }

  /* 1, 2 or 5 of a power of ten, not above the size. */
  function round(size) {
    var power = Math.pow(10, Math.floor(Math.log10(size || 1))), lead = (size || 1) / power;
    return Number(((lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power).toPrecision(1));
  }

  /* ---- what the chosen input does ---- */
  function choose(name) {
    if (name === chosen) { return; }
    chosen = name;
    effect = null;
    document.querySelectorAll(".input").forEach(function (row) { row.classList.toggle("chosen", row.dataset.name === name); });
    checks();
    askEffect();
  }

  var asked = {}, later = {}, advised = null;
  /* A moment after the last move of a hand: effect and advice are runs of many machines. */
  function askFor(what, address, take) {
    clearTimeout(later[what]);
    if (asked[what]) { asked[what].abort(); }
    asked[what] = null;
    if (!address) { return; }
    later[what] = setTimeout(function () {
      var own = asked[what] = new AbortController();
      effectHead();
      fetch(address, { signal: own.signal }).then(function (answer) { return answer.ok ? answer.json() : null; }).then(function (found) {
        if (found && asked[what] === own) { take(found); }
      }).catch(function (fault) { if (fault.name !== "AbortError") { failed(fault); } }).then(function () {
        if (asked[what] === own) { asked[what] = null; checks(); }
      });
    }, PAUSE);
  }

  function askEffect() { askFor("effect", chosen && state.machine ? "effect?input=" + encodeURIComponent(chosen) : "", function (found) { effect = found; }); }

  /* What the checks of the mechanism that is shown advise, as far as they do not hold. */
  function askAdvice() {
    var isAsked = state.machine && current().checks.some(isUnmet);
    advised = null;
    askFor("advice", isAsked ? "advice?mechanism=" + encodeURIComponent(open) : "", function (found) { advised = found; });
  }

  function effectHead() {
    byId("effect-head").textContent = chosen ? t("effect_of", { input: chosen }) + (asked.effect ? " …" : "") : t("effect");
  }

  function line(name, value) {
    var found = effect && effect.checks[name];
    if (!found) { return ""; }
    var x0 = effect.places[0], x1 = effect.places[effect.places.length - 1], across = function (x) { return 130 * (x - x0) / (x1 - x0 || 1); };
    var up = function (y) { return 25 - 24 * Math.min(Math.max(y, 0), 2) / 2; };
    var known = found.utilisation.filter(function (y) { return y !== null; }), svg = drawn("svg", { "class": "effect", viewBox: "0 0 130 26", role: "img" });
    var moves = known.length && Math.max.apply(null, known) - Math.min.apply(null, known) > 1e-4 * Math.max(1, Math.abs(known[0]));
    if (!moves) { return ""; }
    svg.setAttribute("aria-label", t("effect_line", { first: percent(found.utilisation[0]), last: percent(found.utilisation[found.utilisation.length - 1]) }));
    svg.append(drawn("path", { "class": "limit", d: "M0 " + up(1) + "H130" }));
    var path = "", isPen = false;
    found.utilisation.forEach(function (y, index) {
      if (y === null || !effect.exists[index]) { isPen = false; return; }
      path += (isPen ? "L" : "M") + across(effect.places[index]).toFixed(1) + " " + up(y).toFixed(1);
      isPen = true;
    });
    svg.append(drawn("path", { d: path }));
    svg.append(drawn("path", { "class": "now", d: "M" + across(value).toFixed(1) + " 0V26" }));
    return svg;
  }

  /* ---- checks and numbers ---- */
  var turned = {};  /* whether the words of a check are shown, where a hand has chosen it */

  function explained(name, isFailing, title, words) {
    var box = make("details", {}, [make("summary", {}, title), make("p", {}, words)]);
    box.open = name in turned ? turned[name] : isFailing;
    box.querySelector("summary").addEventListener("click", function () { turned[name] = !box.open; });
    return box;
  }

  /* Where a check of another mechanism stands: leads there. */
  function place(mechanism, isTold) {
    if (!isTold) { return ""; }
    var link = make("button", { type: "button", "class": "to" }, mechanism.name);
    link.addEventListener("click", function () { visit(mechanism.name); });
    return link;
  }

  function checks() {
    var every = byId("all-checks").checked, isPress = onPress(), rows = [], input = chosen && everyInput().find(function (each) { return each.name === chosen; });
    state.machine.mechanisms.forEach(function (each) {
      each.checks.forEach(function (check) {
        if (every || each.name === open || (isPress && isUnmet(check))) { rows.push([each, check]); }
      });
    });
    var rank = { fail: 0, warn: 1, pass: 2, not_checked: 3 };
    rows.sort(function (a, b) { return rank[a[1].status] - rank[b[1].status] || (b[1].utilisation || 0) - (a[1].utilisation || 0); });
    effectHead();
    byId("checks").tBodies[0].replaceChildren.apply(byId("checks").tBodies[0], rows.map(function (row) {
      var each = row[0], check = row[1], words = (advised && advised.mechanism === each.name && advised.messages[check.id]) || check.message;
      var title = check.title, was = check.start_status;
      var cell = make("td", {}, [place(each, every || isPress), words ? explained(each.name + "." + check.id, check.status === "fail", title, words) : title]);
      var isOther = was && (was !== check.status || percent(check.start_utilisation) !== percent(check.utilisation));
      return make("tr", { "data-check": each.name + "." + check.id }, [
        make("td", {}, [mark(check.status), " " + t("status_" + check.status)]), cell,
        make("td", { "class": "number" }, percent(check.utilisation)),
        make("td", { "class": "number" + (isOther ? " changed" : "") }, was ? [mark(was), " " + percent(check.start_utilisation)] : t("absent_before")),
        make("td", {}, input ? line(each.name + "." + check.id, input.value) : "")]);
    }));
  }

  var pins = JSON.parse(sessionStorage.getItem("pins") || "[]");  /* MECHANISM.OUTPUT */

  function pin(name) {
    pins = pins.indexOf(name) < 0 ? pins.concat(name) : pins.filter(function (each) { return each !== name; });
    sessionStorage.setItem("pins", JSON.stringify(pins));
    outputs();
    var again = document.querySelector('[data-output="' + CSS.escape(name) + '"] button.pin');
    if (again) { again.focus(); }
  }

  function outputRow(mechanism, each, isAmongPinned) {
    var change = each.change === null || Math.abs(each.change) < 0.0005 ? "" : (each.change > 0 ? "+" : "−") + told(Math.abs(100 * each.change), Math.abs(each.change) < 0.0995 ? 1 : 0) + " %";
    var name = mechanism.name + "." + each.id, isPinned = pins.indexOf(name) >= 0;
    var button = make("button", { type: "button", "class": "pin", "aria-pressed": String(isPinned), title: t("pin"), "aria-label": t("pin_of", { quantity: each.text }) }, isPinned ? "★" : "☆");
    button.addEventListener("click", function () { pin(name); });
    var attributes = {};
    attributes[isAmongPinned ? "data-pinned" : "data-output"] = name;
    return make("tr", attributes, [
      make("td", {}, [place(mechanism, isAmongPinned), each.text + " "].concat(each.symbol ? sign(each.symbol) : [])), make("td", { "class": "number" }, each.shown),
      make("td", { "class": "number" }, each.start), make("td", { "class": "number" + (change ? " changed" : "") }, change), make("td", {}, button)]);
  }

  function outputs() {
    var mechanism = current(), body = byId("pinned").querySelector("tbody"), rows = [];
    byId("outputs").tBodies[0].replaceChildren.apply(byId("outputs").tBodies[0], mechanism.outputs.map(function (each) { return outputRow(mechanism, each, false); }));
    byId("outputs").hidden = byId("outputs-title").hidden = !mechanism.outputs.length;
    state.machine.mechanisms.forEach(function (own) {
      own.outputs.forEach(function (each) { if (pins.indexOf(own.name + "." + each.id) >= 0) { rows.push(outputRow(own, each, true)); } });
    });
    body.replaceChildren.apply(body, rows);
    byId("pinned").hidden = !rows.length;
  }

  /* What the verdict leaves open, beside the press. */
  function openItems() {
    var items = state.machine.open;
    byId("open").hidden = !onPress() || !items.length;
    byId("open").querySelector("summary").textContent = t("open_n", { n: items.length });
    byId("open").querySelector("tbody").replaceChildren.apply(byId("open").querySelector("tbody"), items.map(function (each) {
      return make("tr", {}, [make("td", { "class": "key" }, each.path), make("td", {}, each.why), make("td", {}, each.owner)]);
    }));
  }

  /* ---- states that are kept, and compared ---- */
  var compared = Object.create(null);  /* by name, where a hand has chosen it; else the first and the last */

  function states() {
    var body = byId("states").querySelector("tbody"), last = state.states.length - 1;
    body.replaceChildren.apply(body, state.states.map(function (each, index) {
      var box = make("input", { type: "checkbox", "aria-label": t("compare_of", { state: each.name }) });
      box.checked = each.name in compared ? compared[each.name] : index === 0 || index === last;
      box.addEventListener("change", function () { compared[each.name] = box.checked; comparison(); });
      var acts = each.is_kept ? ["return", "save", "forget"].map(function (name) {
        var button = make("button", { type: "button" }, t("state_" + name));
        button.addEventListener("click", function () {
          act("state/" + name, { name: each.name }).then(function (isDone) { if (isDone && name === "save") { say(t("written", { file: each.name + ".yaml" }), true); } });
        });
        return button;
      }) : [];
      return make("tr", { "data-state": each.name }, [make("td", {}, box), make("td", {}, each.name),
        make("td", {}, [mark(each.verdict), " " + t("verdict_" + each.verdict) + (each.fail ? ": " + each.fail : "")]), make("td", {}, each.governing), make("td", { "class": "acts" }, acts)]);
    }));
    comparison();
  }

  function comparison() {
    var rows = Array.from(byId("states").querySelectorAll("tbody tr")).filter(function (row) { return row.querySelector("input").checked; });
    byId("comparison").href = "comparison?" + rows.map(function (row) { return "state=" + encodeURIComponent(row.dataset.state); }).join("&");
  }

  /* ---- figures: made when they come into sight ---- */
  var sight = new IntersectionObserver(function (entries) {
    entries.forEach(function (entry) { entry.target.isSeen = entry.isIntersecting; if (entry.isIntersecting) { fetchFigure(entry.target); } });
  }, { rootMargin: "200px" });

  function figures(box, place, titles) {
    var wanted = titles.map(function (title, index) { return place + "/" + index; });
    var there = Array.from(box.children).map(function (figure) { return figure.dataset.figure; });
    if (there.join() !== wanted.join()) {
      Array.from(box.children).forEach(function (figure) { sight.unobserve(figure); clear(figure); });
      box.replaceChildren.apply(box, titles.map(function (title, index) {
        var figure = make("figure", { "data-figure": wanted[index] }, [make("figcaption", {}, title), make("div", { "class": "picture" }, make("span", { "class": "waiting" }, t("drawing")))]);
        sight.observe(figure);
        return figure;
      }));
    } else {
      Array.from(box.children).forEach(function (figure) { if (figure.isSeen) { fetchFigure(figure); } });
    }
  }

  function fetchFigure(figure) {
    if (figure.serial === state.serial || (figure.known && state.faults.length)) { return; }
    if (figure.isAsking) { figure.isOld = true; return; }
    var serial = state.serial;
    figure.isAsking = true;
    figure.isOld = false;
    fetch(figure.dataset.figure.split("/").map(encodeURIComponent).join("/")).then(function (answer) { return answer.json(); }).then(function (found) {
      figure.serial = serial;
      put(figure, found);
    }, failed).then(function () { figure.isAsking = false; if (figure.isOld) { fetchFigure(figure); } });
  }

  function clear(figure) { (figure.charts || []).forEach(function (chart) { chart.destroy(); }); figure.charts = []; }

  function put(figure, found) {
    var box = figure.querySelector(".picture"), text = JSON.stringify(found);
    box.querySelectorAll("[data-grip]").forEach(function (bar) { bar.removeAttribute("transform"); });  /* dropped where no machine can be */
    if (text === figure.known) { return; }
    figure.known = text;
    clear(figure);
    var isPlaying = box.querySelector('.r-play[aria-pressed="true"]');
    box.replaceChildren();
    if (found.svg) {
      var drawing = document.importNode(new DOMParser().parseFromString(found.svg, "image/svg+xml").documentElement, true);
      box.append(drawing);
    }
    if (found.moving) {
      motion(figure, box, found);
      if (isPlaying) { box.querySelector(".r-play").click(); }
    } else if (found.plot) {
      figure.charts = found.plot.panels.map(function (panel) { return chart(box, panel, found.plot.rows, figure.dataset.figure.split("/")[1]); });
    } else if (!found.svg) {
      box.textContent = found.refused || "";
    }
  }

  /* A drawing that moves, with what it drives, and the slider that moves them; a new machine goes on where the one before stood. */
  function motion(figure, box, found) {
    var across = found.moving.across, span = across.range, drawing = window.movingDrawing(found.moving, found.rows), driven = window.drivenDrawings(found.moving, found.driven, found.rows);
    var parts = !driven ? [drawing] : onPress() ? [driven, drawing] : [drawing, driven], output = make("output"), input = make("input", { type: "range", min: span[0], max: span[1], step: (span[1] - span[0]) / 720, "aria-label": across.title });
    function go(x) {
      var text = FIGURES.format(Number(x.toPrecision(4))) + (across.unit ? " " + across.unit : "");
      figure.place = input.value = x;
      output.textContent = text;
      input.setAttribute("aria-valuetext", text);
      parts.forEach(function (each) { each.at(x); });
    }
    input.addEventListener("input", function () { go(Number(input.value)); });
    box.append(make("label", { "class": "r-slide" }, [make("span", {}, [across.title + " "].concat(across.symbol ? sign(across.symbol) : [])), input, output]));
    box.append.apply(box, [window.turnPlayer(t("play"), span, function () { return figure.place; }, go)].concat(parts.map(function (each) { return each.node; })));
    grips(drawing.node, found.moving.mechanism, figure.querySelector("figcaption"));
    go(Math.max(span[0], Math.min(figure.place || 0, span[1])));
  }

  /* What stands for a number that may be changed is dragged, with all that stands for the same; the number is sent where it is let go. */
  function grips(drawing, mechanism, caption) {
    delete caption.dataset.moved;
    var all = Array.from(drawing.querySelectorAll("[data-grip]"));
    all.forEach(function (bar) {
      var grip = bar.grip, name = mechanism + "." + grip.input, from = null, typed = null;
      var input = everyInput().find(function (each) { return each.name === name && !each.options; });
      if (!input) { return; }
      var point = grip.per_metre / input.si;
      var same = all.filter(function (each) { return each.grip.input === grip.input; });
      bar.classList.add("grip");
      function shift(way) { same.forEach(function (each) { each.setAttribute("transform", "translate(" + way + " 0)"); }); }
      function end(isMeant) {
        if (from === null) { return; }
        from = null;
        if (isMeant && typed !== null) { change(name, typed); } else { shift(0); delete caption.dataset.moved; }
      }
      bar.addEventListener("pointerdown", function (event) { from = event.clientX; typed = null; bar.setPointerCapture(event.pointerId); event.preventDefault(); });
      bar.addEventListener("pointermove", function (event) {
        if (from === null) { return; }
        var scale = drawing.getScreenCTM().a, way = (event.clientX - from) / scale, step = round(Math.abs(point) / scale);
        var value = Number((Math.round((grip.value / input.si + way * point) / step) * step).toPrecision(9));
        typed = value + (input.unit ? " " + input.unit : "");
        shift(way);
        caption.dataset.moved = name + ": " + typed;
      });
      bar.addEventListener("pointerup", function () { end(true); });
      bar.addEventListener("pointercancel", function () { end(false); });
    });
  }

  /* A colour of the style sheet as the drawing surface takes it. */
  function colour(name) {
    var probe = make("span", { "class": "c-" + name });
    document.body.append(probe);
    var found = getComputedStyle(probe).color;
    probe.remove();
    return found;
  }

  var DASHES = [[], [7, 4], [2, 3], [8, 3, 2, 3]];
  function chart(box, panel, rows, group) {
    var ink = colour("ink"), grid = colour("line"), limit = colour("fail");
    var lines = panel.lines.concat(panel.fills), joined = uPlot.join(lines.map(function (each) { return [rows[each.x], rows[each.y]]; }));
    var axis = { stroke: ink, grid: { stroke: grid, width: 1 }, ticks: { stroke: grid }, values: function (u, places) { return places.map(function (place) { return place === null ? "" : FIGURES.format(place); }); }, font: "12px system-ui, sans-serif", labelFont: "12px system-ui, sans-serif", labelSize: 18 };
    box.append(make("p", { "class": "panel" }, panel.title + (panel.unit ? ", " + panel.unit : "")));
    var made = new uPlot({
      width: Math.max(280, box.clientWidth), height: 240, cursor: { sync: { key: group + panel.across.title + panel.across.unit } },
      scales: { x: { time: false, range: panel.across.range }, y: { range: panel.range } },
      axes: [Object.assign({ label: panel.across.title + (panel.across.unit ? ", " + panel.across.unit : "") }, axis),
        Object.assign({ size: 64 }, axis)],
      series: [{ label: panel.across.symbol || panel.across.title }].concat(lines.map(function (each, index) {
        return { label: each.label || panel.title, stroke: ink, width: 1.5, dash: DASHES[index % DASHES.length], spanGaps: false };
      })),
      hooks: { draw: [function (u) {
        var c = u.ctx, edges = u.bbox, px = window.devicePixelRatio;
        c.save();
        c.strokeStyle = c.fillStyle = limit; c.textAlign = "left"; c.textBaseline = "alphabetic"; c.font = 12 * px + "px system-ui, sans-serif";
        var heights = panel.levels.map(function (level) { return { y: u.valToPos(level.y, "y", true), width: c.measureText(level.text).width }; });
        heights.forEach(function (level) { c.beginPath(); c.moveTo(edges.left, level.y); c.lineTo(edges.left + edges.width, level.y); c.stroke(); });
        window.levelNames(heights, edges, 14 * px).forEach(function (place, index) { c.fillText(panel.levels[index].text, place.x, place.y); });
        c.restore();
      }] }
    }, joined, box);
    made.root.querySelectorAll(".u-label").forEach(function (label) {
      if (/^\p{L}{1,2}(_[\p{L}\p{N},]{1,9})?$/u.test(label.textContent)) { label.replaceChildren.apply(label, sign(label.textContent)); }
    });
    return made;
  }

  /* ---- all of it ---- */
  function show() {
    verdict();
    faults();
    byId("results").hidden = byId("inputs").hidden = byId("mechanisms").hidden = byId("views").hidden = !state.machine;
    if (!state.machine) { return; }
    mechanisms();
    inputs();
    checks();
    outputs();
    openItems();
    states();
    figures(byId("figures"), "figure/" + open, current().figures);
    byId("views").hidden = !state.machine.views.length;
    figures(byId("views"), "view", state.machine.views);
  }

  var source = new EventSource("events");
  source.onmessage = function (event) {
    state = JSON.parse(event.data);
    if (!sending) { ready(); }
    if (isLost || (saidAt !== null && saidAt !== state.serial)) { isLost = false; say(""); }
    advised = null;  /* of the machine before */
    show();
    askEffect();
    askAdvice();
    document.body.dataset.serial = state.serial;
  };
  source.addEventListener("busy", busy);
  source.onerror = function () { isLost = true; say(t("lost")); };

  byId("write").addEventListener("click", function () { act("write").then(function (isDone) { if (isDone) { say(t("written", { file: state.file }), true); } }); });
  ["undo", "redo", "back"].forEach(function (name) { byId(name).addEventListener("click", function () { waiting = {}; act(name); }); });
  document.addEventListener("keydown", function (event) {
    var key = event.key.toLowerCase(), isTyping = event.target.matches("input[type=text], input[type=search]");
    if (!(event.ctrlKey || event.metaKey) || event.altKey || isTyping || (key !== "z" && key !== "y")) { return; }
    event.preventDefault();
    byId(key === "y" || event.shiftKey ? "redo" : "undo").click();
  });
  byId("states").querySelector("form").addEventListener("submit", function (event) {
    event.preventDefault();
    act("state/keep", { name: byId("state-name").value.trim() }).then(function (isDone) { if (isDone) { byId("state-name").value = ""; } });
  });
  /* What sticks below the header begins where it ends. */
  new ResizeObserver(function () { document.documentElement.style.setProperty("--head", document.querySelector("header").offsetHeight + "px"); }).observe(document.querySelector("header"));
  document.querySelectorAll("a.button").forEach(function (link) { link.addEventListener("click", function () { say(t("making"), true); }); });
  /* A part of the drive line leads to its calculation, and the search gives way to it. */
  byId("views").addEventListener("click", function (event) {
    var link = event.target.closest("a");
    if (link) { event.preventDefault(); visit(link.getAttribute("href").slice(1)); byId("results").scrollIntoView(); }
  });
  byId("all-checks").addEventListener("change", checks);
  byId("search").addEventListener("input", function () { if (state && state.machine) { byId("inputs").querySelector(".rows").replaceChildren(); inputs(); } });
})();
