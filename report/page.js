// The ledger's filters, and figures that are enlarged.
"use strict";
(() => {
  const filters = [...document.querySelectorAll("#sums button")], find = document.getElementById("find");
  const rows = [...document.querySelectorAll("#claims tbody")];
  const show = (wanted) => {
    filters.forEach((button) => button.setAttribute("aria-pressed", button.dataset.filter === wanted));
    const words = find.value.toLowerCase().split(/\s+/);
    rows.forEach((row) => {
      const text = row.textContent.toLowerCase();
      row.hidden = (wanted !== "" && row.dataset.outcome !== wanted) || !words.every((word) => text.includes(word));
    });
  };
  const chosen = () => filters.find((button) => button.getAttribute("aria-pressed") === "true").dataset.filter;
  filters.forEach((button) => button.addEventListener("click", () => show(button.dataset.filter)));
  if (find) {
    find.addEventListener("input", () => show(chosen()));
    show("");
  }

  const dialog = document.getElementById("enlarged");
  document.querySelectorAll("button.enlarge").forEach((button) => button.addEventListener("click", () => {
    const [picture, caption] = [button.querySelector("img"), button.parentElement.querySelector("figcaption")];
    dialog.querySelector("img").src = picture.srcset.split(" ")[0];
    dialog.querySelector("img").alt = picture.alt;
    dialog.querySelector("p").innerHTML = caption.innerHTML;
    dialog.showModal();
  }));
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog || event.target.tagName === "IMG")
      dialog.close();
  });
})();
