#include "client/cli/german_help.h"

#include <algorithm>
#include <array>
#include <string>

#include "client/cli/program_options.h"

namespace trc::cli {
namespace {

struct Row {
  std::string_view english;
  std::string_view german;
};

constexpr auto rows = std::to_array<Row>({
    {"Tool radius compensation: computes the path of the tool centre beside a contour.",
     "Werkzeugradiuskorrektur: berechnet die Bahn des Werkzeugmittelpunkts neben einer "
     "Kontur."},
    {"Exit codes: 0 done, 1 the program was refused or gouges, 2 wrong call, 3 server "
     "not reachable, 4 a limit was met, 5 internal fault.",
     "Rückgabewerte: 0 erledigt, 1 das Programm wurde abgelehnt oder verletzt die "
     "Kontur, 2 falscher Aufruf, 3 Server nicht erreichbar, 4 eine Grenze wurde "
     "erreicht, 5 innerer Fehler."},
    {"Print this help message and exit", "Diese Hilfe zeigen"},
    {"Display program version information and exit", "Die Version zeigen"},
    {"Compensate an NC program: G41 and G42 resolved, G40 throughout",
     "Ein NC-Programm korrigieren: G41 und G42 aufgelöst, überall G40"},
    {"Draw the programmed contour (black) and the compensated path (blue)",
     "Die programmierte Kontur (schwarz) und die korrigierte Bahn (blau) zeichnen"},
    {"Say what tools of many radii make of a program, and which is the largest that fits",
     "Sagen, was Werkzeuge vieler Radien aus einem Programm machen, und welches das "
     "größte ist, das passt"},
    {"Measure how near the compensated path comes to the programmed contour",
     "Messen, wie nahe die korrigierte Bahn der programmierten Kontur kommt"},
    {"Show a program and its path in a browser: serves a page on this machine until "
     "interrupted",
     "Ein Programm und seine Bahn im Browser zeigen: eine Seite auf diesem Rechner, bis "
     "zum Abbruch"},
    {"Write a sample contour as an NC program", "Eine Beispielkontur als NC-Programm schreiben"},
    {"Run many generated clients against a server and measure",
     "Viele erzeugte Clients auf einen Server loslassen und messen"},
    {"Show version, limits, settings, #TRC options, G functions and diagnostics of the "
     "service; with a FILE: its dialect, its selections and what would be refused",
     "Version, Grenzen, Einstellungen, #TRC-Optionen, G-Funktionen und Meldungen des "
     "Dienstes zeigen; "
     "mit einer Datei: ihren Dialekt, ihre Anwahlen und was abgelehnt würde"},
    {"Say what a diagnostic means, what causes it and what helps, with a program that "
     "raises it",
     "Sagen, was eine Meldung bedeutet, woher sie kommt und was hilft, mit einem "
     "Programm, das sie auslöst"},
    {"Ask a server whether it takes work", "Einen Server fragen, ob er Arbeit annimmt"},
    {"Print the script that completes words of this command line in a shell",
     "Das Skript ausgeben, das in einer Shell die Wörter dieser Befehlszeile ergänzt"},
    {"NC program; - reads standard input", "NC-Programm; - liest die Standardeingabe"},
    {"NC program, or several; - reads standard input",
     "NC-Programm, auch mehrere; - liest die Standardeingabe"},
    {"What holds before the first line, as in tool_radius=5; may be repeated",
     "Was vor der ersten Zeile gilt, wie in tool_radius=5; auch mehrmals"},
    {"Language of the program; isg without it", "Sprache des Programms; ohne Angabe isg"},
    {"What lengths count in before the program says; mm without it",
     "Worin Längen zählen, solange das Programm nichts anderes vorgibt; ohne Angabe mm"},
    {"copy: lines with unknown G functions come out as they are while TRC is off",
     "copy: Zeilen mit unbekannten G-Funktionen bleiben, wie sie sind, solange die "
     "Korrektur aus ist"},
    {"What a variable holds that the program does not set itself, as in #500=12.5; may "
     "be repeated",
     "Was eine Variable enthält, die das Programm nicht selbst setzt, wie in #500=12.5; "
     "auch mehrmals"},
    {"File of a subprogram that the program calls, or a folder of such files; may be "
     "repeated. Those of heidenhain are not followed, only looked through for RL, RR",
     "Datei eines Unterprogramms, das das Programm aufruft, oder ein Ordner solcher "
     "Dateien; auch mehrmals. Die von heidenhain werden nicht verfolgt, nur nach RL, RR "
     "durchgesehen"},
    {"Lines that a program with loops and calls executes at most; 10000000 without it",
     "Zeilen, die ein Programm mit Schleifen und Aufrufen höchstens ausführt; ohne "
     "Angabe 10000000"},
    {"What coordinates of fanuc without a decimal point count in: units (X10 is 10 mm) "
     "or increments (X10 is 0.010 mm, 0.0010 in)",
     "Worin Koordinaten ohne Dezimalpunkt bei fanuc zählen: units (X10 ist 10 mm) oder "
     "increments (X10 ist 0.010 mm, 0.0010 in)"},
    {"Table of tools: CSV with the header number,radius, as wanted with name and edge "
     "(mm, whatever the program counts in, unless a first line unit,inch or a column "
     "unit says otherwise), a tool table of LinuxCNC, TOOL.T of Heidenhain, G10 lines "
     "of Fanuc, tool data of Sinumerik ($TC_DP6 and $TC_DP15 of a TOA file) or of ISG "
     "(wz[1].radius)",
     "Werkzeugtabelle: CSV mit der Kopfzeile number,radius, auf Wunsch mit name und "
     "edge (mm, worin auch immer das Programm zählt, wenn nicht eine erste Zeile "
     "unit,inch oder eine Spalte unit anderes sagt), Werkzeugtabelle von LinuxCNC, "
     "TOOL.T von Heidenhain, G10-Zeilen von Fanuc, Werkzeugdaten von Sinumerik ($TC_DP6 "
     "und $TC_DP15 einer TOA-Datei) oder von ISG (wz[1].radius)"},
    {"Radius of the tool before the program says, mm: --set tool_radius",
     "Radius des Werkzeugs, bis das Programm einen nennt, mm: --set tool_radius"},
    {"What that tool is larger by, mm; negative: worn off: --set wear",
     "Um wie viel dieses Werkzeug größer ist, mm; negativ: abgenutzt: --set wear"},
    {"Language of messages: en or de; without it that of LC_ALL, LC_MESSAGES or LANG",
     "Sprache der Meldungen: en oder de; ohne Angabe die von LC_ALL, LC_MESSAGES oder "
     "LANG"},
    {"Errors alone: no warnings, no progress, no line of summary",
     "Nur Fehler: keine Warnungen, kein Fortschritt, keine Zusammenfassung"},
    {"Also what was taken: dialect, unit, setup, tools, service; and times",
     "Auch, was angenommen wurde: Dialekt, Einheit, Einstellungen, Werkzeuge, Dienst; "
     "und Zeiten"},
    {"Server to ask", "Server, der gefragt wird"},
    {"Server to ask, or several with commas between; without it the work is done in "
     "this process",
     "Server, der gefragt wird, oder mehrere mit Kommas dazwischen; ohne Angabe rechnet "
     "dieser Prozess"},
    {"How long to wait for a server that has no room, shuts down or was lost, s; 0: not "
     "at all",
     "Wie lange auf einen Server gewartet wird, der voll ist, endet oder verloren ging, "
     "s; 0: gar nicht"},
    {"Without a server: what this process may take; else all there is",
     "Ohne Server: was dieser Prozess nehmen darf; sonst alles, was da ist"},
    {"Without a server: what a program may hold of it; else five eighths",
     "Ohne Server: was ein Programm davon halten darf; sonst fünf Achtel"},
    {"Without a server: most blocks between G41 or G42 and G40; else 20000000",
     "Ohne Server: meiste Sätze zwischen G41 oder G42 und G40; sonst 20000000"},
    {"Certificate (PEM) the server is known by",
     "Zertifikat (PEM), an dem der Server erkannt wird"},
    {"Certificate (PEM) of this client", "Zertifikat (PEM) dieses Clients"},
    {"Key (PEM) of that certificate", "Schlüssel (PEM) dieses Zertifikats"},
    {"How long to wait for the answer", "Wie lange auf die Antwort gewartet wird"},
    {"nc: NC program, jsonl: one JSON object per block, listing: one line per block",
     "nc: NC-Programm, jsonl: ein JSON-Objekt je Satz, listing: eine Zeile je Satz"},
    {"File to write, else standard output. An NC program appears there, too, only when "
     "all of it was compensated",
     "Zieldatei, sonst Standardausgabe. Ein NC-Programm erscheint auch dort erst, wenn "
     "es ganz korrigiert ist"},
    {"Let -o replace the program itself", "-o darf das Programm selbst ersetzen"},
    {"Decimal places of coordinates, 1 to 8; in an NC program 4, or those of the program where it "
     "has "
     "more",
     "Nachkommastellen der Koordinaten, 1 bis 8; in einem NC-Programm 4, oder so viele, wie das "
     "Programm hat, wenn das mehr sind"},
    {"Dialect to write: motions, feeds, M, S and T in its words, absolute and in mm. A "
     "program that says more is refused by the word",
     "Dialekt der Ausgabe: Wege, Vorschübe, M, S und T in seinen Wörtern, absolut und "
     "in mm. Ein Programm, das mehr sagt, wird mit dem Wort abgelehnt"},
    {"Directory for the results of all programs, under their names, and a record of "
     "each. What has not changed since is left out",
     "Ordner für die Ergebnisse aller Programme, unter ihren Namen, und ein Protokoll "
     "zu jedem. Was sich seitdem nicht geändert hat, wird ausgelassen"},
    {"Programs at a time, with --output-dir", "Programme zugleich, mit --output-dir"},
    {"File to write a record of the job to: what was made of which bytes with which "
     "settings, and how it was measured. trc verify --record checks it",
     "Datei für das Protokoll des Auftrags: was woraus mit welchen Einstellungen wurde "
     "und wie es gemessen ist. trc verify --record prüft es"},
    {"The path is measured against the contour on its way (verify=report): where it "
     "comes nearer than the tool\n"
     "radius, warning 900216 says where. verify=enforce refuses such a program, "
     "verify=off measures nothing.",
     "Die Bahn wird dabei an der Kontur gemessen (verify=report): wo sie näher kommt "
     "als der Werkzeugradius,\n"
     "sagt Warnung 900216, wo. verify=enforce lehnt ein solches Programm ab, verify=off "
     "misst nicht."},
    {"Picture to write, .svg or .html; - is SVG",
     "Bild, das geschrieben wird, .svg oder .html; - ist SVG"},
    {"svg, a picture, or html, a page that needs no server, of at most 250000 blocks; "
     "by default the ending of the name says it",
     "svg, ein Bild, oder html, eine Seite ohne Server mit höchstens 250000 Sätzen; "
     "ohne Angabe sagt es die Endung des Namens"},
    {"Write block numbers beside the contour (svg)",
     "Satznummern neben die Kontur schreiben (svg)"},
    {"Mark where the blocks end (svg)", "Satzenden markieren (svg)"},
    {"Leads, approach and retract are thin, rapid moves dashed, masked or removed "
     "blocks red, transition blocks light blue; red\n"
     "and dashed is what was programmed where another contour is compensated "
     "(CONV_CIR_TO_LIN,\n"
     "KERF_MASKING). Warnings are yellow at their place. Where the radius changes both "
     "tools are drawn.\n"
     "Other planes that are compensated have views of their own; where the third axis "
     "moves there is one from the side.\n"
     "Where the measured path comes nearer to the contour than the tool radius, warning "
     "900216 says\n"
     "where. A refused program gives the picture of what was certain, with the place "
     "marked, and exit code 1;\n"
     "what is proposed in place of an approach or a retract is green and dashed.\n"
     "An .html file is the page of trc view with the program inside: contour, path, "
     "listings and what\n"
     "was found. It opens from the disk, loads nothing and holds at most 250000 blocks "
     "of contour and path.",
     "An- und Abfahrwege sind dünn, Eilgänge gestrichelt, ausgeblendete oder entfernte "
     "Sätze rot, Übergangssätze hellblau;\n"
     "rot und gestrichelt ist das Programmierte, wo eine andere Kontur korrigiert wird "
     "(CONV_CIR_TO_LIN,\n"
     "KERF_MASKING). Warnungen stehen gelb an ihrer Stelle. Wo sich der Radius ändert, "
     "sind beide Werkzeuge gezeichnet.\n"
     "Weitere korrigierte Ebenen haben eigene Ansichten; wo sich die dritte Achse "
     "bewegt, gibt es eine von der Seite.\n"
     "Wo die gemessene Bahn der Kontur näher kommt als der Werkzeugradius, sagt Warnung "
     "900216, wo. Ein\n"
     "abgelehntes Programm gibt das Bild dessen, was sicher war, mit der Stelle "
     "markiert, und Rückgabewert 1;\n"
     "was anstelle eines An- oder Abfahrwegs vorgeschlagen wird, ist grün und "
     "gestrichelt.\n"
     "Eine .html-Datei ist die Seite von trc view mit dem Programm darin: Kontur, Bahn, "
     "Listen und was\n"
     "gefunden wurde. Sie öffnet sich von der Platte, lädt nichts und hält höchstens "
     "250000 Sätze von Kontur und Bahn."},
    {"Radii to ask about, mm: 3,5,8 or 3:8:0.5, from, to and step; 64 at most",
     "Gefragte Radien, mm: 3,5,8 oder 3:8:0.5, von, bis und Schritt; höchstens 64"},
    {"Picture of what each radius cannot reach", "Bild dessen, was jeder Radius nicht erreicht"},
    {"Without the largest radius that reaches every wall",
     "Ohne den größten Radius, der jede Wand erreicht"},
    {"Print what was found as one JSON object", "Das Gefundene als ein JSON-Objekt ausgeben"},
    {"With --tools the radii are those of the table, wear added. A radius takes the "
     "place of every one that\n"
     "the program gives, by D and T words as well; --wear and allowance are added to "
     "each. Exit code 1 when\n"
     "the program cannot be read with any radius.",
     "Mit --tools sind es die Radien der Tabelle samt Verschleiß. Ein Radius tritt an "
     "die Stelle jedes Radius,\n"
     "den das Programm nennt, auch mit D und T; --wear und allowance kommen zu jedem "
     "dazu. Rückgabewert 1,\n"
     "wenn das Programm mit keinem Radius gelesen werden kann."},
    {"Do the job of this record again and say whether the same comes out, and whether "
     "the file written then still holds it; without FILE of the program it names",
     "Den Auftrag dieses Protokolls noch einmal ausführen und sagen, ob dasselbe "
     "herauskommt und ob die Datei von damals es noch enthält; ohne Datei das Programm, "
     "das es nennt"},
    {"Every block between approach and retract is measured against every contour block "
     "of its selection,\n"
     "by a method of its own that knows nothing of how the path was made. Exit code 1 "
     "when the path comes\n"
     "nearer than the tool radius, or when an approach or a retract leads through the contour.",
     "Jeder Satz zwischen An- und Abfahren wird an jedem Kontursatz seiner Anwahl "
     "gemessen, mit einem\n"
     "eigenen Verfahren, das nicht weiß, wie die Bahn entstand. Rückgabewert 1, wenn "
     "die Bahn näher kommt\n"
     "als der Werkzeugradius, oder wenn ein An- oder Abfahrweg durch die Kontur führt."},
    {"Address of the page; port 0 takes a free one",
     "Adresse der Seite; Port 0 nimmt einen freien"},
    {"Print the address only", "Nur die Adresse ausgeben"},
    {"What is cut", "Was gefräst wird"},
    {"Contour blocks", "Kontursätze"},
    {"Which of the random contours", "Welche der zufälligen Konturen"},
    {"mm", "mm"},
    {"File to write; else standard output", "Zieldatei; sonst Standardausgabe"},
    {"Shapes:", "Formen:"},
    {"60 equal lines", "60 gleiche Geraden"},
    {"lines and quarter circles, tangential", "Geraden und Viertelkreise, tangential"},
    {"8 tips, sharp outside and inside corners", "8 Spitzen, scharfe Außen- und Innenecken"},
    {"24 teeth of lines and arcs", "24 Zähne aus Geraden und Bögen"},
    {"24 quarter circles and lines, inside corners between them",
     "24 Viertelkreise und Geraden, dazwischen Innenecken"},
    {"quarter circles that grow", "wachsende Viertelkreise"},
    {"a ring of waves of 100 lines each, travelled once",
     "ein Ring aus Wellen von je 100 Geraden, einmal durchfahren"},
    {"lines and arcs chosen by the seed, one in three an arc",
     "Geraden und Bögen nach dem Startwert (--seed), jeder dritte Satz ein Bogen"},
    {"The same shape, seed, radius and number of blocks give the same text everywhere.",
     "Gleiche Form, gleicher Startwert, Radius und gleiche Zahl der Sätze geben überall "
     "denselben Text."},
    {"Open loop: streams a second, begun on a schedule that does not wait for the "
     "server; latencies count from it",
     "Offener Kreis: Streams je Sekunde, begonnen nach einem Plan, der nicht auf den "
     "Server wartet; Wartezeiten zählen ab ihm"},
    {"Closed loop (the default): each stream is followed by the next at once",
     "Geschlossener Kreis (wie ohne Angabe): jedem Stream folgt sofort der nächste"},
    {"Streams open at once; with --rate, at most", "Zugleich offene Streams; mit --rate höchstens"},
    {"Connections the streams are spread over", "Verbindungen, auf die sich die Streams verteilen"},
    {"Seconds to measure, after the ramp", "Sekunden, die gemessen wird, nach dem Anlauf"},
    {"Seconds in which the load grows from nothing", "Sekunden, in denen die Last von null wächst"},
    {"End after so many streams, if that is sooner",
     "Nach so vielen Streams enden, wenn das früher ist"},
    {"Share of the streams, 0 to 1, that wait 50 ms before each answer they read",
     "Anteil der Streams, 0 bis 1, die vor jeder Antwort, die sie lesen, 50 ms warten"},
    {"Share of the streams, 0 to 1, that are cancelled half way",
     "Anteil der Streams, 0 bis 1, die auf halbem Weg abgebrochen werden"},
    {"Share of the streams, 0 to 1, whose result is compared with that of the core of "
     "this program, bit for bit",
     "Anteil der Streams, 0 bis 1, deren Ergebnis Bit für Bit mit dem des Kerns dieses "
     "Programms verglichen wird"},
    {"Contour of every stream (trc generate --help)", "Kontur jedes Streams (trc generate --help)"},
    {"The contour is made for it, mm; the tool has it unless --set says another",
     "Für ihn ist die Kontur gemacht, mm; das Werkzeug hat ihn, wenn --set keinen "
     "anderen nennt"},
    {"Contour blocks of a stream", "Kontursätze eines Streams"},
    {"Blocks, or lines, in a message", "Sätze oder Zeilen in einer Nachricht"},
    {"columns or blocks (CompensatePath), text (CompensateProgram)",
     "columns oder blocks (CompensatePath), text (CompensateProgram)"},
    {"G141 with REMOVE_MASKED_BLOCKS", "G141 mit REMOVE_MASKED_BLOCKS"},
    {"Initial value, key=value (trc compensate --help)",
     "Anfangswert, name=wert (trc compensate --help)"},
    {"Print the report as one JSON object", "Den Bericht als ein JSON-Objekt ausgeben"},
    {"Every stream sends the same contour. An interrupt (^C) ends the run with the "
     "report so far.",
     "Jeder Stream sendet dieselbe Kontur. Ein Abbruch (^C) beendet den Lauf mit dem "
     "Bericht bis dahin."},
    {"Print one table as Markdown, in English as the documentation has it",
     "Eine Tabelle als Markdown ausgeben, auf Englisch wie in der Dokumentation"},
    {"Code of a message, as in 90019, or its name, as in LINE_REVERSED; without it all "
     "are listed",
     "Nummer einer Meldung, wie 90019, oder ihr Name, wie LINE_REVERSED; ohne Angabe "
     "alle als Liste"},
    {"Print the program alone", "Nur das Programm ausgeben"},
    {"Exit codes: 0 serving, 1 not serving (it is about to stop), 3 not reachable.",
     "Rückgabewerte: 0 nimmt Arbeit an, 1 nimmt keine an (er endet bald), 3 nicht "
     "erreichbar."},
    {"bash, zsh or fish", "bash, zsh oder fish"},
    {"For this shell alone: source <(trc completion bash)",
     "Nur für diese Shell: source <(trc completion bash)"},
});

void replace(std::string& text, std::string_view english, std::string_view german) {
  for (std::size_t at = text.find(english); at != std::string::npos;
       at = text.find(english, at + german.size()))
    text.replace(at, english.size(), german);
}

// The text below the options consists of the rows and of the list of settings.
std::string footer_in_german(std::string text) {
  replace(text, settings_help(Language::english), settings_help(Language::german));
  for (const Row& row : rows) replace(text, row.english, row.german);
  return text;
}

void speak_german_of_one(CLI::App& command) {
  if (const auto german = german_help_of(command.get_description()))
    command.description(std::string(*german));
  command.footer(footer_in_german(command.get_footer()));
  for (CLI::Option* option : command.get_options()) {
    if (const auto german = german_help_of(option->get_description()))
      option->description(std::string(*german));
    if (option->get_group() == "Options") option->group("Optionen");
  }
}

}  // namespace

std::optional<std::string_view> german_help_of(std::string_view english) {
  const auto* const row = std::ranges::find(rows, english, &Row::english);
  if (row == rows.end()) return std::nullopt;
  return row->german;
}

void speak_german(CLI::App& app) {
  speak_german_of_one(app);
  const auto all = [](const CLI::App*) { return true; };
  for (CLI::App* command : app.get_subcommands(all)) {
    speak_german_of_one(*command);
    command->group("Befehle");
  }
  // Commands share the formatter of the program.
  const auto formatter = app.get_formatter();
  formatter->label("Usage", "Aufruf");
  formatter->label("OPTIONS", "OPTIONEN");
  formatter->label("SUBCOMMAND", "BEFEHL");
  formatter->label("Positionals", "Argumente");
  formatter->label("REQUIRED", "PFLICHT");
  formatter->label("Env", "Umgebung");
  formatter->label("Needs", "Nur mit");
  formatter->label("Excludes", "Nicht mit");
}

}  // namespace trc::cli
