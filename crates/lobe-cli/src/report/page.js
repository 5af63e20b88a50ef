"use strict";
// Tables are sorted by a click on a heading, and by a second one the other way round.
for (const table of document.querySelectorAll("table")) {
  const headings = [...table.tHead.rows[0].cells];
  headings.forEach((heading, column) => {
    const button = document.createElement("button");
    button.type = "button";
    button.append(...heading.childNodes);
    heading.append(button);
    button.addEventListener("click", () => {
      const down = heading.getAttribute("aria-sort") === "ascending";
      headings.forEach((other) => other.removeAttribute("aria-sort"));
      heading.setAttribute("aria-sort", down ? "descending" : "ascending");
      const rows = [...table.tBodies[0].rows].map((row) => {
        const text = row.cells[column].textContent.trim();
        return { row, text, number: parseFloat(text) };
      });
      // By number if every cell that says something begins with one.
      const numbers = rows.every(({ text, number }) => text === "–" || !Number.isNaN(number));
      const less = numbers
        ? (a, b) => (Number.isNaN(a.number) ? Infinity : a.number) - (Number.isNaN(b.number) ? Infinity : b.number) || 0
        : (a, b) => a.text.localeCompare(b.text, "en", { numeric: true });
      rows.sort((a, b) => (down ? less(b, a) : less(a, b)));
      table.tBodies[0].append(...rows.map(({ row }) => row));
    });
  });
}
// Pictures and plots open large.
const dialog = document.createElement("dialog");
dialog.addEventListener("click", () => dialog.close());
document.body.append(dialog);
for (const picture of document.querySelectorAll("figure > img, figure > svg, td > img")) {
  const button = document.createElement("button");
  button.type = "button";
  button.className = "open";
  button.setAttribute("aria-label", "Open large: " + (picture.getAttribute("alt") || picture.querySelector("title")?.textContent || "plot"));
  picture.replaceWith(button);
  button.append(picture);
  button.addEventListener("click", () => {
    dialog.replaceChildren(picture.cloneNode(true));
    dialog.showModal();
  });
}
