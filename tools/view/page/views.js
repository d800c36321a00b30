// The six captured views, as pictures that can be clicked.

const order = ['-x', '+x', '-y', '+y', '-z', '+z'];

/** @param {(view: any) => void} choose @returns {any[]} the views in the order shown */
export function showViews(scene, choose) {
  const views = order.map((name) => scene.views.find((view) => view.name === name)).filter(Boolean);
  const section = document.getElementById('views-section');
  section.hidden = views.length === 0;
  views.forEach((view, index) => {
    const button = document.createElement('button');
    button.id = `view-${index + 1}`;
    button.setAttribute('aria-pressed', 'false');
    const image = document.createElement('img');
    image.alt = `captured from ${view.name}`;
    button.append(image, `${index + 1}: from ${view.name.replace('-', '−')}`);
    button.addEventListener('click', () => choose(view));
    document.getElementById('views').append(button);
    view.button = button;
  });
  return views;
}

/** Normals beside normals, else the colours. */
export function dressViews(views, mode) {
  const what = mode === 'normal' ? 'normal' : 'colour';
  for (const view of views) view.button.firstChild.src = view[what];
}

export function markView(views, chosen) {
  for (const view of views) view.button.setAttribute('aria-pressed', String(view === chosen));
}
