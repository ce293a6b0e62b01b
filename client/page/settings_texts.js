// What the settings are called, and their words and meanings in German. Meanings, units, ranges and
// initial values come from the server: a meaning is looked up by its English text, so that one that
// has changed is not shown with an old translation.
const names = {
  plane: ['Plane', 'Ebene'],
  start_position: ['Start position', 'Startposition'],
  'start_position.x': ['Start position X', 'Startposition X'],
  'start_position.y': ['Start position Y', 'Startposition Y'],
  'start_position.z': ['Start position Z', 'Startposition Z'],
  tool_radius: ['Tool radius', 'Werkzeugradius'],
  wear: ['Wear', 'Verschleiß'],
  tools: ['Tool table', 'Werkzeugtabelle'],
  dialect: ['Dialect', 'Dialekt'],
  unit: ['Unit', 'Maßeinheit'],
  selection_mode: ['Selection and deselection', 'An- und Abwahl'],
  transition: ['Outside corners', 'Außenecken'],
  contour_masking: ['Contour masking', 'Konturausblendung'],
  feed_adaptation: ['Feed adaptation', 'Vorschubanpassung'],
  tangfeed_min_radius: ['Smallest radius of the feed adaptation', 'Kleinster Radius der Vorschubanpassung'],
  min_feed_factor: ['Smallest feed factor', 'Kleinster Vorschubfaktor'],
  'circle_center_mode.reference': ['Circle centre counts from', 'Kreismittelpunkt zählt ab'],
  'circle_center_mode.correction': ['Correction of the circle centre', 'Korrektur des Kreismittelpunkts'],
  'circle_center_mode.max_shift': ['Largest shift of the centre', 'Größte Verschiebung des Mittelpunkts'],
  'circle_center_mode.max_shift_factor': ['Largest shift of the centre, share of the radius', 'Größte Verschiebung des Mittelpunkts, Anteil des Radius'],
  'circle_center_mode.max_radius_difference': ['Largest difference of the radii', 'Größter Unterschied der Radien'],
  'circle_center_mode.max_radius_difference_factor': ['Largest difference of the radii, share', 'Größter Unterschied der Radien, Anteil'],
  'circle_center_mode.warn_shift': ['Warn from this shift of the centre', 'Warnen ab dieser Verschiebung'],
  'options.conv_cir_to_lin': ['#TRC CONV_CIR_TO_LIN', '#TRC CONV_CIR_TO_LIN'],
  'options.kerf_masking': ['#TRC KERF_MASKING', '#TRC KERF_MASKING'],
  'options.reverse': ['#TRC REVERSE', '#TRC REVERSE'],
  'options.ignore_cont_damage': ['#TRC IGNORE_CONT_DAMAGE', '#TRC IGNORE_CONT_DAMAGE'],
  'options.remove_masked_blocks': ['#TRC REMOVE_MASKED_BLOCKS', '#TRC REMOVE_MASKED_BLOCKS'],
  'options.ext_angle_block_intersection': ['#TRC EXT_ANGLE_BLOCK_INTERSECTION', '#TRC EXT_ANGLE_BLOCK_INTERSECTION'],
  'options.g236_lin': ['#TRC G236_LIN', '#TRC G236_LIN'],
  'options.stretch_factor': ['#TRC STRETCH_FACTOR', '#TRC STRETCH_FACTOR'],
  'options.tangential_limit': ['#TRC TANGENTIAL_LIMIT', '#TRC TANGENTIAL_LIMIT'],
  'options.perpendicular_radius_change': ['#TRC PERPENDICULAR_RADIUS_CHANGE', '#TRC PERPENDICULAR_RADIUS_CHANGE'],
  'options.gen_cir_block_in_corner': ['#TRC GEN_CIR_BLOCK_IN_CORNER', '#TRC GEN_CIR_BLOCK_IN_CORNER'],
  'options.suppress_trc': ['#TRC SUPPRESS_TRC', '#TRC SUPPRESS_TRC'],
  'options.split.measure': ['#TRC SPLIT: by', '#TRC SPLIT: nach'],
  'options.split.place': ['#TRC SPLIT: where', '#TRC SPLIT: wo'],
  'options.split.axis': ['#TRC SPLIT: axis', '#TRC SPLIT: Achse'],
  'options.split.dist_seg1': ['#TRC SPLIT: first length', '#TRC SPLIT: erste Länge'],
  'options.split.feed_seg1': ['#TRC SPLIT: first feed', '#TRC SPLIT: erster Vorschub'],
  'options.split.dist_seg2': ['#TRC SPLIT: second length', '#TRC SPLIT: zweite Länge'],
  'options.split.feed_seg2': ['#TRC SPLIT: second feed', '#TRC SPLIT: zweiter Vorschub'],
  'options.inverse': ['#TRC INVERSE', '#TRC INVERSE'],
  'options.online': ['#TRC ONLINE', '#TRC ONLINE'],
  'options.online_by_vector': ['#TRC ONLINE_BY_VECTOR', '#TRC ONLINE_BY_VECTOR'],
  look_ahead_blocks: ['Look-ahead in blocks', 'Vorausschau in Sätzen'],
  implicit_contour_masking: ['Implicit contour masking', 'Implizite Konturausblendung'],
  kerf_method: ['Method of KERF_MASKING', 'Verfahren von KERF_MASKING'],
  axis_names: ['Names of tracking axes', 'Namen der Mitschleppachsen'],
  max_passive_blocks: ['Most blocks without motion in a row', 'Höchstens so viele Sätze ohne Bewegung'],
  include_inverse_path: ['Recovered contour in the path', 'Rückgerechnete Kontur in der Bahn'],
  verify: ['Measure the path', 'Bahn nachmessen'],
  leads: ['Approach and retract blocks', 'An- und Abfahrsätze'],
  'leads.find': ['Approach and retract blocks: find', 'An- und Abfahrsätze: suchen'],
  'leads.blocks_in': ['Approach blocks', 'Anfahrsätze'],
  'leads.blocks_out': ['Retract blocks', 'Abfahrsätze'],
  closing_tolerance: ['Gap that still closes a contour', 'Lücke, die eine Kontur noch schließt'],
  max_masked_share: ['Largest share left out', 'Größter ausgelassener Anteil'],
  input_resolution: ['Resolution of the program', 'Auflösung des Programms'],
  allowance: ['Allowance', 'Aufmaß'],
  nominal_radius: ['Radius of the centre path', 'Radius der Mittelpunktsbahn'],
  max_wear: ['Largest wear', 'Größter Verschleiß'],
  unknown_words: ['Unknown words', 'Unbekannte Wörter'],
  pass_words: ['Words that pass', 'Wörter, die bleiben'],
  encoding: ['Bytes in comments', 'Bytes in Kommentaren'],
  renumber: ['Number blocks anew', 'Sätze neu nummerieren'],
  max_executed_lines: ['Lines executed at most', 'Höchstens ausgeführte Zeilen'],
  variables: ['Variables', 'Variablen'],
  block_skip: ['Lines with /', 'Zeilen hinter /'],
  whole_numbers: ['Numbers without a point', 'Zahlen ohne Punkt'],
};

// Words of a choice, and what a setting takes.
const germanWords = {
  'a number': 'eine Zahl', 'a whole number': 'eine ganze Zahl', text: 'Text', 'x,y,z in mm': 'x,y,z in mm',
  'names with commas between': 'Namen, mit Kommas dazwischen',
  'names with their values, as in #500=12.5,#501=3': 'Namen mit ihren Werten, wie in #500=12.5,#501=3',
  'auto, none or blocks:IN,OUT': 'auto, none oder blocks:EIN,AUS',
  'the tool table, number of the D or T word:radius in mm, as in 1:5,2:3.5, or with the wear too, as in 1:5:-0.02; a name stands in quotes, an edge after a slash, as in 7"ROUGH"/2:5':
    'Nummer des D- oder T-Worts:Radius in mm, wie 1:5,2:3.5, mit Verschleiß 1:5:-0.02, mit Name und Schneide 7"ROUGH"/2:5',
  true: 'ja', false: 'nein', off: 'aus', on: 'ein', none: 'keine', auto: 'selbst finden', blocks: 'gezählt',
  direct: 'direkt', indirect: 'indirekt', on_path: 'auf der Bahn', perpendicular: 'senkrecht',
  inside_corner: 'in der Innenecke', without_block: 'ohne Satz', linear: 'linear', circular: 'zirkular',
  absolute: 'absolut', start: 'Startpunkt', axis: 'Achse', path: 'Bahn', pre: 'Anwahl', post: 'Abwahl',
  combined: 'beide', enforce: 'und ablehnen, was zu nah kommt', report: 'und melden', refuse: 'ablehnen', copy: 'übernehmen', execute: 'ausführen', leave_out: 'weglassen',
  units: 'ganze Einheiten', increments: 'kleinste Schritte',
  inch: 'Zoll', degrees: 'Grad',
};
const englishWords = {true: 'yes', false: 'no', on_path: 'on the path', inside_corner: 'inside corner', without_block: 'without block'};
// Of the controls, the same in both.
const controls = {isg: 'ISG, Beckhoff', fanuc: 'Fanuc, Haas, ISO', linuxcnc: 'LinuxCNC', sinumerik: 'Sinumerik', heidenhain: 'Heidenhain'};

const germanMeanings = {
  'the plane of the contour': 'Ebene der Kontur',
  'where the tool stands; coordinates that are left out are 0': 'wo das Werkzeug steht; fehlende Koordinaten sind 0',
  'where the tool stands in X': 'wo das Werkzeug in X steht',
  'where the tool stands in Y': 'wo das Werkzeug in Y steht',
  'where the tool stands in Z': 'wo das Werkzeug in Z steht',
  'the size of the tool; negative: on the other side; with nominal_radius what the tool differs from that; without it a selection needs a D or T word':
    'Größe des Werkzeugs; negativ: auf der anderen Seite; mit nominal_radius der Unterschied zu diesem; ohne ihn braucht eine Anwahl ein D- oder T-Wort',
  'how the tool reaches and leaves the path; fanuc, linuxcnc and sinumerik begin with direct':
    'wie das Werkzeug auf die Bahn kommt und sie verlässt; fanuc, linuxcnc und sinumerik beginnen mit direct',
  'what is inserted at outside corners; linuxcnc and sinumerik begin with circular':
    'was an Außenecken eingefügt wird; linuxcnc und sinumerik beginnen mit circular',
  'what becomes of contour that the tool cannot cut: off stops there, on leaves it out':
    'was mit Kontur geschieht, die das Werkzeug nicht schneiden kann: off hält dort an, on lässt sie aus',
  'where the programmed feed holds: off at the tool centre, on at the contour; sinumerik begins with on':
    'wo der programmierte Vorschub gilt: off an der Werkzeugmitte, on an der Kontur; sinumerik beginnt mit on',
  'smallest radius of arcs on which G11 adapts the feed; 0: all': 'kleinster Radius von Bögen, auf denen G11 den Vorschub anpasst; 0: alle',
  'smallest factor that G11 puts on a feed': 'kleinster Faktor, mit dem G11 einen Vorschub ändert',
  'what circle centres I, J, K count from': 'ab wo Kreismittelpunkte I, J, K zählen',
  'whether the centre is moved where it does not fit the end point': 'ob der Mittelpunkt verschoben wird, wo er nicht zum Endpunkt passt',
  'G165: largest shift of a centre, else 20035': 'G165: größte Verschiebung eines Mittelpunkts, sonst 20035',
  'G165: largest shift of a centre as a share of the radius': 'G165: größte Verschiebung eines Mittelpunkts als Anteil des Radius',
  'G164: largest difference of start and end radius, else 21758': 'G164: größter Unterschied von Start- und Endradius, sonst 21758',
  'G164: largest difference of both radii as a share of the radius': 'G164: größter Unterschied beider Radien als Anteil des Radius',
  'G165: a larger shift of a centre is told (900221)': 'G165: eine größere Verschiebung eines Mittelpunkts wird gemeldet (900221)',
  'SPLIT: by the travel of an axis, by the path, or not at all': 'SPLIT: nach dem Weg einer Achse, nach der Bahn oder gar nicht',
  'SPLIT: at selection, at deselection, or at both': 'SPLIT: bei der Anwahl, bei der Abwahl oder bei beiden',
  'SPLIT: the axis, 1 for X, 2 for Y, 3 for Z': 'SPLIT: die Achse, 1 für X, 2 für Y, 3 für Z',
  'window of contour masking in blocks; 0: the whole selection': 'Fenster der Konturausblendung in Sätzen; 0: die ganze Anwahl',
  'look for contour violations as G141 does, and stop at the first one': 'sucht Konturverletzungen wie G141 und hält bei der ersten an',
  'how KERF_MASKING finds the points it moves: lines alone, or arcs as well': 'wie KERF_MASKING die Punkte findet, die es verschiebt: nur Strecken oder auch Bögen',
  'the axes beside X, Y and Z, at most 32': 'die Achsen neben X, Y und Z, höchstens 32',
  'most blocks without motion in a row (90011); not isg: 10000': 'höchstens so viele Sätze ohne Bewegung in Folge (90011); nicht isg: 10000',
  'also the contour that is recovered from the path': 'auch die Kontur, die aus der Bahn zurückgerechnet ist',
  'measure the path: report warns of what comes too near (900216), enforce refuses it; compensate and plot report':
    'misst die Bahn nach: report warnt vor dem, was zu nah kommt (900216), enforce lehnt es ab',
  'which blocks of a contour are leads and bound no material': 'welche Sätze einer Kontur an- und abfahren und kein Material begrenzen',
  'how leads are found': 'wie An- und Abfahrsätze gefunden werden',
  'leads after the approach block, with leads.find=blocks': 'Anfahrsätze hinter dem Anwahlsatz, mit leads.find=blocks',
  'leads before the retract block, with leads.find=blocks': 'Abfahrsätze vor dem Abwahlsatz, mit leads.find=blocks',
  'up to here the end of a contour meets its start': 'bis dahin trifft das Ende einer Kontur ihren Anfang',
  'largest share of the wall of a selection that may be left out, in one stretch or in all those longer than 10 tool radii (900218)':
    'größter Anteil der Wand einer Anwahl, der ausgelassen werden darf, am Stück oder in allen Stücken über 10 Werkzeugradien (900218)',
  'how finely the program is written; less counts as touching': 'wie fein das Programm geschrieben ist; weniger gilt als Berührung',
  'stock that is left on the part; negative: cuts deeper': 'was am Teil stehen bleibt; negativ: schneidet tiefer',
  'the tool whose centre path the program is; without it the program is the contour':
    'das Werkzeug, dessen Mittelpunktsbahn das Programm ist; ohne ihn ist das Programm die Kontur',
  'a larger wear is refused (900222)': 'ein größerer Verschleiß wird abgelehnt (900222)',
  'what the tool is larger by; negative: worn off; max_wear allows more than 1':
    'um so viel ist das Werkzeug größer; negativ: abgenutzt; max_wear erlaubt mehr als 1',
  'lines with /, as the switch of the machine stands: execute is off, leave_out on; refuse what hangs on it (900017)':
    'Zeilen hinter /, wie der Schalter der Maschine steht: execute aus, leave_out ein; refuse lehnt ab, was davon abhängt (900017)',
  'words unknown here that say nothing about the path, as POPEN,G777: they pass, also in a contour':
    'hier unbekannte Wörter, die über den Weg nichts sagen, wie POPEN,G777: sie bleiben, auch in einer Kontur',
  'bytes in comments: utf8 alone (900007), latin1 and auto any; isg utf8, else auto':
    'Bytes in Kommentaren: utf8 allein (900007), latin1 und auto beliebige; isg utf8, sonst auto',
  'number the blocks anew, also those that are inserted': 'die Sätze neu nummerieren, auch die eingefügten',
  'lines that a program with loops and calls executes at most (900301)':
    'so viele Zeilen führt ein Programm mit Schleifen und Aufrufen höchstens aus (900301)',
  'what variables hold that the program does not set itself':
    'was Variablen enthalten, die das Programm nicht selbst setzt',
  'the tools of D words, and of T words in a program without D': 'die Werkzeuge der D-Wörter, ohne D im Programm der T-Wörter',
  'the control the program is for': 'die Steuerung, für die das Programm ist',
  'what the program counts in where it does not say so itself': 'worin das Programm zählt, wo es das nicht selbst sagt',
  'words nobody knows: refuse stops there, copy leaves them in the program':
    'unbekannte Wörter: refuse hält dort an, copy lässt sie im Programm',
  'coordinates of fanuc without a decimal point: X10 is 10 mm in units, 0.010 mm in increments':
    'Koordinaten von fanuc ohne Dezimalpunkt: X10 ist 10 mm mit units, 0.010 mm mit increments',
  'arcs too small for the tool become lines (with G141)': 'Bögen, für die das Werkzeug zu groß ist, werden Strecken (mit G141)',
  'points in kerfs the tool cannot enter are moved': 'Punkte in Kerben, in die das Werkzeug nicht kommt, werden verschoben',
  'the side changes at points of reversal without a block': 'die Seite wechselt an Umkehrpunkten ohne Zwischensatz',
  'contour violations do not stop': 'Konturverletzungen halten nicht an',
  'contour loops are removed (with G141)': 'Konturschleifen werden entfernt (mit G141)',
  'nothing is inserted up to 181 degrees': 'bis 181 Grad wird nichts eingefügt',
  'G236 inserts a line in place of an arc, 90 to 180 degrees': 'G236 fügt zwischen 90 und 180 Grad eine Strecke statt eines Bogens ein',
  'longest stretch of a block, in tool radii': 'größte Verlängerung eines Satzes, in Werkzeugradien',
  'turns up to this count as tangential': 'Knicke bis dahin gelten als tangential',
  'a new radius acts at once, across the contour': 'ein neuer Radius wirkt sofort, quer zur Kontur',
  'inside corners get a circle of radius 0': 'Innenecken erhalten einen Kreis mit Radius 0',
  'only KERF_MASKING acts, nothing is offset': 'nur KERF_MASKING wirkt, nichts wird versetzt',
  'needs ONLINE, 22125 without it': 'verlangt ONLINE, ohne es 22125',
  'compensation of a radius that changes while machining': 'Korrektur eines Radius, der sich beim Bearbeiten ändert',
  'ONLINE for a wire that is inclined': 'ONLINE für einen geneigten Draht',
  'SPLIT: length of the first segment': 'SPLIT: Länge des ersten Abschnitts',
  'SPLIT: feed of the first segment': 'SPLIT: Vorschub im ersten Abschnitt',
  'SPLIT: length of the second segment': 'SPLIT: Länge des zweiten Abschnitts',
  'SPLIT: feed of the second segment': 'SPLIT: Vorschub im zweiten Abschnitt',
};

export const settingName = (name, language) => names[name]?.[language === 'de' ? 1 : 0] ?? name;
// What a setting takes, or a word of a choice, as the server gives it: "direct (G138)".
export function settingWord(word, language) {
  const [, name, rest] = /^([a-z_0-9]+)( \(.*\))?$/.exec(word) ?? [null, word, ''];
  const known = controls[name] ?? (language === 'de' ? germanWords : englishWords)[name] ?? name;
  return known + (rest ?? '');
}
export const settingMeaning = (meaning, language) => (language === 'de' ? germanMeanings[meaning] : null) ?? meaning;
export const hasName = name => name in names;
