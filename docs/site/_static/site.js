/* Lets the keyboard reach what scrolls sideways: wide tables, code and formulas. */
(() => {
  const reach = () => {
    for (const each of document.querySelectorAll("pre, .table-wrapper, .eq, .fig")) {
      if (each.scrollWidth > each.clientWidth + 1 || each.scrollHeight > each.clientHeight + 1) each.tabIndex = 0;
      else each.removeAttribute("tabindex");
    }
  };
  addEventListener("DOMContentLoaded", reach);
  addEventListener("load", reach);
  addEventListener("resize", reach);
})();
