<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="de_DE">
    <context>
        <name />
        <message>
            <source>in {exercise_id} targets are touched, and the arm inserts along a path: name another exercise, or leave out --device arm</source>
            <translation type="unfinished">in {exercise_id} werden Ziele berührt, der Arm aber führt entlang eines Pfads ein: Nennen Sie eine andere Übung oder lassen Sie --device arm weg</translation>
        </message>
        <message>
            <source>the arm works before its own simulated cameras; leave out --pen and --cameras</source>
            <translation type="unfinished">der Arm arbeitet vor seinen eigenen simulierten Kameras; lassen Sie --pen und --cameras weg</translation>
        </message>
        <message>
            <source>&amp;Sessions</source>
            <translation type="unfinished">&amp;Sitzungen</translation>
        </message>
        <message>
            <source>Watch the arm do my plan</source>
            <translation type="unfinished">Dem Arm bei meinem Plan zusehen</translation>
        </message>
        <message>
            <source>A simulated arm carries out the plan on screen. {only}</source>
            <translation type="unfinished">Ein simulierter Arm führt den Plan auf dem Bildschirm aus. {only}</translation>
        </message>
        <message>
            <source>Watch the arm (W)</source>
            <translation type="unfinished">Dem Arm zusehen (W)</translation>
        </message>
        <message>
            <source>A simulated arm carries out the plan; it counts for nobody, and drives no real arm</source>
            <translation type="unfinished">Ein simulierter Arm führt den Plan aus; es zählt für niemanden und bewegt keinen echten Arm</translation>
        </message>
        <message>
            <source>The arm is at it already; Esc stops it.</source>
            <translation type="unfinished">Der Arm ist schon dabei; Esc hält ihn an.</translation>
        </message>
        <message>
            <source>Choose an exercise first: File ▸ Start page.</source>
            <translation type="unfinished">Wählen Sie zuerst eine Übung: Datei ▸ Startseite.</translation>
        </message>
        <message>
            <source>An attempt is running: end it first, then let the arm do your plan.</source>
            <translation type="unfinished">Ein Versuch läuft: Beenden Sie ihn zuerst, dann führt der Arm Ihren Plan aus.</translation>
        </message>
        <message>
            <source>This is an assessment: you do it yourself, the arm cannot do it for you.</source>
            <translation type="unfinished">Dies ist eine Prüfung: Sie machen es selbst, der Arm kann es nicht für Sie tun.</translation>
        </message>
        <message>
            <source>Here targets are touched: the arm inserts along a path and leaves them to you.</source>
            <translation type="unfinished">Hier werden Ziele berührt: Der Arm führt entlang eines Pfads ein und überlässt sie Ihnen.</translation>
        </message>
        <message>
            <source>The arm does not do what you may not begin: {why}.</source>
            <translation type="unfinished">Was Sie nicht beginnen dürfen, tut auch der Arm nicht: {why}.</translation>
        </message>
        <message>
            <source>Place entry and target first (E, T): the arm follows your plan.</source>
            <translation type="unfinished">Setzen Sie zuerst Einstichpunkt und Ziel (E, T): Der Arm folgt Ihrem Plan.</translation>
        </message>
        <message>
            <source>Finish a plan that the robot can follow first; the panel Plan says why not.</source>
            <translation type="unfinished">Stellen Sie zuerst einen Plan fertig, dem der Roboter folgen kann; der Bereich Plan sagt, was fehlt.</translation>
        </message>
        <message>
            <source>Simulated arm: works out its way …  {only}</source>
            <translation type="unfinished">Simulierter Arm: berechnet seinen Weg …  {only}</translation>
        </message>
        <message>
            <source>Simulated arm: works out its way, {n:.0f} %</source>
            <translation type="unfinished">Simulierter Arm: berechnet seinen Weg, {n:.0f} %</translation>
        </message>
        <message>
            <source>Let it stand {angle:.0f}° further round, and try again</source>
            <translation type="unfinished">Um {angle:.0f}° weiter herum aufstellen und erneut versuchen</translation>
        </message>
        <message>
            <source>The plan was changed meanwhile: ask again for the new one.</source>
            <translation type="unfinished">Der Plan wurde inzwischen geändert: Fordern Sie den Arm für den neuen noch einmal an.</translation>
        </message>
        <message>
            <source>You have the needle: go on with mouse or keys. This attempt counts for nobody.</source>
            <translation type="unfinished">Sie haben die Nadel: Machen Sie mit Maus oder Tasten weiter. Dieser Versuch zählt für niemanden.</translation>
        </message>
        <message>
            <source>the arm does it</source>
            <translation type="unfinished">der Arm macht es</translation>
        </message>
        <message>
            <source>points have shape {points_shape}; (n, 2) or (n, 3) is needed</source>
            <translation type="unfinished">die Punkte haben die Form {points_shape}; (n, 2) oder (n, 3) ist nötig</translation>
        </message>
        <message>
            <source>{points_shape} points have normals of shape {normals_shape}</source>
            <translation type="unfinished">Punkte der Form {points_shape} haben Normalen der Form {normals_shape}</translation>
        </message>
        <message>
            <source>{name} is {bound}; give 0 or more</source>
            <translation type="unfinished">{name} ist {bound}; geben Sie 0 oder mehr an</translation>
        </message>
        <message>
            <source>in the plane no contact turns about its normal; leave soft at 0</source>
            <translation type="unfinished">in der Ebene dreht sich kein Kontakt um seine Normale; lassen Sie soft auf 0</translation>
        </message>
        <message>
            <source>no force holds the tool: {reason}</source>
            <translation type="unfinished">keine Kraft hält das Instrument: {reason}</translation>
        </message>
        <message>
            <source>a friction cone in space with {edges} edges; give 3 or more</source>
            <translation type="unfinished">ein Reibkegel im Raum mit {edges} Kanten; geben Sie 3 oder mehr an</translation>
        </message>
        <message>
            <source>all contacts are one point: torques have no scale; give scale=...</source>
            <translation type="unfinished">alle Kontakte sind ein Punkt: Drehmomente haben keinen Maßstab; geben Sie scale=... an</translation>
        </message>
        <message>
            <source>the torque scale is {scale} m; a positive length is needed</source>
            <translation type="unfinished">der Maßstab der Drehmomente ist {scale} m; nötig ist eine positive Länge</translation>
        </message>
        <message>
            <source>the origin is outside the wrenches' hull: no ray ends in it</source>
            <translation type="unfinished">der Ursprung liegt außerhalb der Hülle der Kraftwinder: Kein Strahl endet in ihr</translation>
        </message>
        <message>
            <source>no closed form for {rays} rays of {dimensions} dimensions, only for two contacts in the plane</source>
            <translation type="unfinished">keine geschlossene Form für {rays} Strahlen in {dimensions} Dimensionen, nur für zwei Kontakte in der Ebene</translation>
        </message>
        <message>
            <source>this test is for two contacts in the plane</source>
            <translation type="unfinished">diese Prüfung gilt für zwei Kontakte in der Ebene</translation>
        </message>
        <message>
            <source>both contacts are one point: no line joins them</source>
            <translation type="unfinished">beide Kontakte sind ein Punkt: Keine Linie verbindet sie</translation>
        </message>
        <message>
            <source>a linear programme of {unknowns} unknowns ended with: {ending}</source>
            <translation type="unfinished">ein lineares Programm mit {unknowns} Unbekannten endete mit: {ending}</translation>
        </message>
        <message>
            <source>hand: {name} is {length} m; a positive length is needed</source>
            <translation type="unfinished">Hand: {name} ist {length} m; nötig ist eine positive Länge</translation>
        </message>
        <message>
            <source>hand: {name} is {angle} rad; give more than 0, at most π</source>
            <translation type="unfinished">Hand: {name} ist {angle} rad; geben Sie mehr als 0 an, höchstens π</translation>
        </message>
        <message>
            <source>hand: pad is {pad} m; give 0 or more, less than distal, {distal} m</source>
            <translation type="unfinished">Hand: pad ist {pad} m; geben Sie 0 oder mehr an, weniger als distal, {distal} m</translation>
        </message>
        <message>
            <source>hand: bend is {bend} rad; give 0 or more, less than π</source>
            <translation type="unfinished">Hand: bend ist {bend} rad; geben Sie 0 oder mehr an, weniger als π</translation>
        </message>
        <message>
            <source>hand: gears {proximal_gear} (proximal) and {distal_gear} (distal); the distal one must be positive and the smaller, or the tip would open in closing</source>
            <translation type="unfinished">Hand: Übersetzungen {proximal_gear} (proximal) und {distal_gear} (distal); die distale muss positiv und die kleinere sein, sonst ginge die Spitze beim Schließen auf</translation>
        </message>
        <message>
            <source>hand: breakaway is {breakaway} N·m; a positive torque is needed</source>
            <translation type="unfinished">Hand: breakaway ist {breakaway} N·m; nötig ist ein positives Drehmoment</translation>
        </message>
        <message>
            <source>finger {finger_name} does not reach ({x:.6g}, {y:.6g}, {z:.6g}) mm: {reason}</source>
            <translation type="unfinished">Finger {finger_name} erreicht ({x:.6g}, {y:.6g}, {z:.6g}) mm nicht: {reason}</translation>
        </message>
        <message>
            <source>the motor stands at {motor} rad and joint 2 broke away at {broken_at} rad; give 0 ≤ broken_at ≤ motor</source>
            <translation type="unfinished">der Motor steht bei {motor} rad, und Gelenk 2 löste sich bei {broken_at} rad; geben Sie 0 ≤ broken_at ≤ motor an</translation>
        </message>
        <message>
            <source>it is {reach_mm:.4g} mm from joint 2, the links reach from {near:.4g} to {far:.4g} mm</source>
            <translation type="unfinished">der Punkt liegt {reach_mm:.4g} mm von Gelenk 2, die Glieder reichen von {near:.4g} bis {far:.4g} mm</translation>
        </message>
        <message>
            <source>{name} would be {angle_deg:.4g}°, its limits are 0 and {most_deg:.4g}°</source>
            <translation type="unfinished">{name} wäre {angle_deg:.4g}°, die Grenzen sind 0 und {most_deg:.4g}°</translation>
        </message>
        <message>
            <source>closing moves the grasp point by {free:.4g} m/rad, with joint 2 held by {alone:.4g} m/rad; both must be into the tool: choose another posture</source>
            <translation type="unfinished">Schließen bewegt den Greifpunkt um {free:.4g} m/rad, mit festgehaltenem Gelenk 2 um {alone:.4g} m/rad; beides muss in das Instrument gehen: Wählen Sie eine andere Stellung</translation>
        </message>
        <message>
            <source>contact: {name} is {setting} {unit_name}; give {least}</source>
            <translation type="unfinished">Kontakt: {name} ist {setting} {unit_name}; nötig: {least}</translation>
        </message>
        <message>
            <source>firm grasp: {name} is {setting}; give more than 0</source>
            <translation type="unfinished">fester Griff: {name} ist {setting}; geben Sie mehr als 0 an</translation>
        </message>
        <message>
            <source>firm grasp: gain is {gain} rad/s per N; give more than 0</source>
            <translation type="unfinished">fester Griff: gain ist {gain} rad/s je N; geben Sie mehr als 0 an</translation>
        </message>
        <message>
            <source>a gain of {used_gain:.4g} rad/s per N makes a contact of {contact_stiffness:.4g} N/m and {contact_damping:.4g} N·s/m oscillate ever more; give less than {most:.4g}, or leave it out</source>
            <translation type="unfinished">eine Verstärkung von {used_gain:.4g} rad/s je N lässt einen Kontakt von {contact_stiffness:.4g} N/m und {contact_damping:.4g} N·s/m immer stärker schwingen; geben Sie weniger als {most:.4g} an oder lassen Sie sie weg</translation>
        </message>
        <message>
            <source>after {seconds:.3g} s the force is {force:.4g} N, not {goal:.4g} N; give it more time, or a gain for a softer contact</source>
            <translation type="unfinished">nach {seconds:.3g} s ist die Kraft {force:.4g} N, nicht {goal:.4g} N; geben Sie mehr Zeit oder eine Verstärkung für einen weicheren Kontakt</translation>
        </message>
        <message>
            <source>a press of {duration} s has {count:.4g} periods of {law_period} s; give 1 to 1e6</source>
            <translation type="unfinished">ein Druck von {duration} s hat {count:.4g} Perioden von {law_period} s; geben Sie 1 bis 1e6 vor</translation>
        </message>
        <message>
            <source>no hand {wanted!r}; valid names: {hand_names}, or the path of a .yaml file</source>
            <translation type="unfinished">keine Hand {wanted!r}; gültige Namen: {hand_names}, oder der Pfad einer .yaml-Datei</translation>
        </message>
        <message>
            <source>a tool of diameter {diameter} m; a positive one is needed</source>
            <translation type="unfinished">ein Instrument mit Durchmesser {diameter} m; nötig ist ein positiver</translation>
        </message>
        <message>
            <source>the palm would come along the tool's axis; give a direction across it (the axis is {round})</source>
            <translation type="unfinished">die Handfläche käme entlang der Achse des Instruments; geben Sie eine Richtung quer dazu an (die Achse ist {round})</translation>
        </message>
        <message>
            <source>the tool's axis at {chosen_mm:.4g} mm above joint 2: the tips meet on a tool of {tool_world_diameter_mm:.4g} mm from {least_mm:.4g} to {most_mm:.4g} mm</source>
            <translation type="unfinished">die Achse des Instruments {chosen_mm:.4g} mm über Gelenk 2: Die Fingerspitzen treffen sich an einem Instrument von {tool_world_diameter_mm:.4g} mm zwischen {least_mm:.4g} und {most_mm:.4g} mm</translation>
        </message>
        <message>
            <source>a tool of {radius_mm:.4g} mm: the fingers open to {widest_mm:.4g} mm and cannot close on it</source>
            <translation type="unfinished">ein Instrument von {radius_mm:.4g} mm: Die Finger öffnen bis {widest_mm:.4g} mm und können sich nicht darum schließen</translation>
        </message>
        <message>
            <source>a tool of {radius_mm:.4g} mm would be met at {most_mm:.4g} mm above joint 2, where it is in the palm</source>
            <translation type="unfinished">ein Instrument von {radius_mm:.4g} mm würde {most_mm:.4g} mm über Gelenk 2 getroffen, wo es in der Handfläche steckt</translation>
        </message>
        <message>
            <source>spread {spread_deg:.4g}°; its limits are 0 and {geometry_most_spread_deg:.4g}°</source>
            <translation type="unfinished">Spreizung {spread_deg:.4g}°; die Grenzen sind 0 und {geometry_most_spread_deg:.4g}°</translation>
        </message>
        <message>
            <source>finger {finger_name} stands in the tool with its {link} link when open; move the hand back, or change the spread</source>
            <translation type="unfinished">Finger {finger_name} steht offen mit dem Glied {link} im Instrument; rücken Sie die Hand zurück oder ändern Sie die Spreizung</translation>
        </message>
        <message>
            <source>finger {finger_name} closes to its limit without touching the tool; bring the hand nearer, or change the spread</source>
            <translation type="unfinished">Finger {finger_name} schließt bis zum Anschlag, ohne das Instrument zu berühren; bringen Sie die Hand näher heran oder ändern Sie die Spreizung</translation>
        </message>
        <message>
            <source>the tool stands in the palm, {deep}; the palm lies {geometry_joint_height_mm:.3g} mm below joint 2: move the hand back</source>
            <translation type="unfinished">das Instrument steckt in der Handfläche, {deep}; die Handfläche liegt {geometry_joint_height_mm:.3g} mm unter Gelenk 2: Rücken Sie die Hand zurück</translation>
        </message>
        <message>
            <source>the path leans {lean:.0f}° from straight down; a tool goes through the skin up to {flattest_deg:.0f}°</source>
            <translation type="unfinished">der Pfad ist um {lean:.0f}° gegen die Senkrechte geneigt; ein Instrument geht bis {flattest_deg:.0f}° durch die Haut</translation>
        </message>
        <message>
            <source>{name} has shape {array_shape}; (7,) is needed</source>
            <translation type="unfinished">{name} hat die Form {array_shape}; (7,) ist nötig</translation>
        </message>
        <message>
            <source>{name} is not finite: {array}</source>
            <translation type="unfinished">{name} ist nicht endlich: {array}</translation>
        </message>
        <message>
            <source>wrist centre ({x:.6g}, {y:.6g}, {z:.6g}) m is {reach:.6g} m from the shoulder; the links span {least:.4g} to {most:.4g} m</source>
            <translation type="unfinished">die Handgelenkmitte ({x:.6g}, {y:.6g}, {z:.6g}) m liegt {reach:.6g} m von der Schulter; die Glieder reichen von {least:.4g} bis {most:.4g} m</translation>
        </message>
        <message>
            <source>{refusal}; nearest_pose gives the nearest that is within the joint limits</source>
            <translation type="unfinished">{refusal}; nearest_pose gibt die nächste Lage innerhalb der Gelenkgrenzen</translation>
        </message>
        <message>
            <source>{refusal}; the nearest that they reach is ({x:.4f}, {y:.4f}, {z:.4f}) m (nearest_pose)</source>
            <translation type="unfinished">{refusal}; der nächste erreichbare Ort ist ({x:.4f}, {y:.4f}, {z:.4f}) m (nearest_pose)</translation>
        </message>
        <message>
            <source>arm {name}: {quantity} is {length} m; a positive length is needed</source>
            <translation type="unfinished">Arm {name}: {quantity} ist {length} m; nötig ist eine positive Länge</translation>
        </message>
        <message>
            <source>arm {name}: limits {lower} to {upper} rad; every joint must turn both ways from zero</source>
            <translation type="unfinished">Arm {name}: Grenzen {lower} bis {upper} rad; jedes Gelenk muss sich von null aus in beide Richtungen drehen</translation>
        </message>
        <message>
            <source>no arm {name_or_path!r}; there is iiwa14, or the path of a .yaml file</source>
            <translation type="unfinished">kein Arm {name_or_path!r}; es gibt iiwa14 oder den Pfad einer .yaml-Datei</translation>
        </message>
        <message>
            <source>no published description of arm {name!r}; there is iiwa14</source>
            <translation type="unfinished">keine veröffentlichte Beschreibung des Arms {name!r}; es gibt iiwa14</translation>
        </message>
        <message>
            <source>joint {joint} would stand {margin_deg:.3g}° beyond its limits, at the best arm angle tried: {in_words}</source>
            <translation type="unfinished">Gelenk {joint} stünde {margin_deg:.3g}° jenseits seiner Grenzen, beim besten probierten Armwinkel: {in_words}</translation>
        </message>
        <message>
            <source>no arc: the start is {radius:.6g} m from the axis and {up:.6g} m along it, the end {its:.6g} m and {other:.6g} m; both must be alike, and off the axis</source>
            <translation type="unfinished">kein Bogen: Der Anfang liegt {radius:.6g} m von der Achse und {up:.6g} m entlang ihr, das Ende {its:.6g} m und {other:.6g} m; beides muss gleich sein, und nicht auf der Achse</translation>
        </message>
        <message>
            <source>tips have shape {tips_shape}; (n, 3) with two or more are needed</source>
            <translation type="unfinished">die Spitzen haben die Form {tips_shape}; (n, 3) mit zwei oder mehr ist nötig</translation>
        </message>
        <message>
            <source>a sweep has two places of the tip that follow and are the same</source>
            <translation type="unfinished">in einer Bahn der Spitze sind zwei aufeinanderfolgende Orte gleich</translation>
        </message>
        <message>
            <source>the arm gets {share:.3g} % of the way, to ({x:.4g}, {y:.4g}, {z:.4g}) m: {reason}</source>
            <translation type="unfinished">der Arm kommt {share:.3g} % des Wegs weit, bis ({x:.4g}, {y:.4g}, {z:.4g}) m: {reason}</translation>
        </message>
        <message>
            <source>; with its base at ({x:.4g}, {y:.4g}, {z:.4g}) m it could</source>
            <translation type="unfinished">; mit der Basis bei ({x:.4g}, {y:.4g}, {z:.4g}) m könnte er es</translation>
        </message>
        <message>
            <source>; no base within {away:g} m of where it stands was found that could</source>
            <translation type="unfinished">; innerhalb von {away:g} m von seinem Standort wurde keine Basis gefunden, mit der er es könnte</translation>
        </message>
        <message>
            <source>the last count returns or raises</source>
            <translation type="unfinished">die letzte Anzahl gibt zurück oder wirft eine Ausnahme</translation>
        </message>
        <message>
            <source>joint {joint} stands {step_deg:.3g}° from the posture that the motion begins with</source>
            <translation type="unfinished">Gelenk {joint} steht {step_deg:.3g}° neben der Stellung, mit der die Bewegung beginnt</translation>
        </message>
        <message>
            <source>joint {joint} would jump by {step_deg:.3g}°: to go on it needs another posture</source>
            <translation type="unfinished">Gelenk {joint} würde um {step_deg:.3g}° springen: Zum Weiterfahren braucht der Arm eine andere Stellung</translation>
        </message>
        <message>
            <source>the shaft would pass the fulcrum at {off_mm:.3g} mm</source>
            <translation type="unfinished">der Schaft würde {off_mm:.3g} mm am Drehpunkt vorbeigehen</translation>
        </message>
        <message>
            <source>its dexterity falls to {dexterity:.2g} ({names}); {least_dexterity:g} is the least</source>
            <translation type="unfinished">seine Beweglichkeit sinkt auf {dexterity:.2g} ({names}); {least_dexterity:g} ist das Mindeste</translation>
        </message>
        <message>
            <source>a joint would pass its limit between two postures</source>
            <translation type="unfinished">ein Gelenk würde zwischen zwei Stellungen seine Grenze überschreiten</translation>
        </message>
        <message>
            <source>a path needs two knots or more, ascending; s is {s}</source>
            <translation type="unfinished">eine Bahn braucht zwei oder mehr Knoten, aufsteigend; s ist {s}</translation>
        </message>
        <message>
            <source>no grip brings the tool into the trocar: {tried}</source>
            <translation type="unfinished">kein Griff bringt das Instrument in den Trokar: {tried}</translation>
        </message>
        <message>
            <source>{grip}: {reason}</source>
            <translation type="unfinished">{grip}: {reason}</translation>
        </message>
        <message>
            <source>{phase}: {reason}</source>
            <translation type="unfinished">{phase}: {reason}</translation>
        </message>
        <message>
            <source>{collision} after {share:.0f} %</source>
            <translation type="unfinished">{collision} nach {share:.0f} %</translation>
        </message>
        <message>
            <source>{things_touched} at its end</source>
            <translation type="unfinished">{things_touched} am Ende</translation>
        </message>
        <message>
            <source>the tool of {length} m is gripped {grip} m from its tip; grip it on its length</source>
            <translation type="unfinished">das Instrument von {length} m ist {grip} m von seiner Spitze gegriffen; greifen Sie es innerhalb seiner Länge</translation>
        </message>
        <message>
            <source>largest tilt of the shaft is {tilt_deg}°; it must be within (0°, 90°)</source>
            <translation type="unfinished">größte Neigung des Schafts ist {tilt_deg}°; sie muss zwischen 0° und 90° liegen</translation>
        </message>
        <message>
            <source>the tip is {depth_mm:.3g} mm from the fulcrum: there it has no direction, and its scale no value; from {least_depth_mm:g} mm on it has, nearer the tool is slid along a given one</source>
            <translation type="unfinished">die Spitze liegt {depth_mm:.3g} mm vom Drehpunkt: Dort hat sie keine Richtung und ihr Maßstab keinen Wert; ab {least_depth_mm:g} mm hat sie beides, näher wird das Instrument entlang einer vorgegebenen geschoben</translation>
        </message>
        <message>
            <source>the shaft would lean {tilt_deg:.4g}° from the trocar's axis; it grazes beyond {largest_tilt_deg:.4g}°</source>
            <translation type="unfinished">der Schaft wäre {tilt_deg:.4g}° gegen die Achse des Trokars geneigt; über {largest_tilt_deg:.4g}° streift er</translation>
        </message>
        <message>
            <source>at a depth of {depth_mm:.4g} mm the grip would be {outside_mm:.4g} mm from the fulcrum; at least {clearance_mm:.4g} mm are needed: grip the tool further back</source>
            <translation type="unfinished">bei einer Tiefe von {depth_mm:.4g} mm läge der Griff {outside_mm:.4g} mm vom Drehpunkt; mindestens {clearance_mm:.4g} mm sind nötig: Greifen Sie das Instrument weiter hinten</translation>
        </message>
        <message>
            <source>the arm's dexterity is {dexterity:.2g} with the tool rolled by {roll_deg:.0f}°; holding needs {least_dexterity:g}</source>
            <translation type="unfinished">die Beweglichkeit des Arms ist {dexterity:.2g} mit um {roll_deg:.0f}° gerolltem Instrument; Halten braucht {least_dexterity:g}</translation>
        </message>
        <message>
            <source>the arm's dexterity is {seen_dexterity:.2g} ({names}); rates need {least_dexterity:g}: plan around it</source>
            <translation type="unfinished">die Beweglichkeit des Arms ist {seen_dexterity:.2g} ({names}); Geschwindigkeiten brauchen {least_dexterity:g}: Planen Sie darum herum</translation>
        </message>
        <message>
            <source>the arm touches something</source>
            <translation type="unfinished">der Arm berührt etwas</translation>
        </message>
        <message>
            <source>the {name} has a joint {excess:.3g} rad beyond</source>
            <translation type="unfinished">{name}: ein Gelenk steht {excess:.3g} rad jenseits seiner Grenze</translation>
        </message>
        <message>
            <source>the arm touches something at the {name}: begin and end where it is free</source>
            <translation type="unfinished">der Arm berührt etwas bei {name}: Beginnen und enden Sie, wo er frei ist</translation>
        </message>
        <message>
            <source>start and goal are the same posture: there is nothing to move</source>
            <translation type="unfinished">Anfang und Ziel sind dieselbe Stellung: Es gibt nichts zu bewegen</translation>
        </message>
        <message>
            <source>with the tip at the {name} the arm touches something, or has no posture</source>
            <translation type="unfinished">mit der Spitze bei {name} berührt der Arm etwas oder hat keine Stellung</translation>
        </message>
        <message>
            <source>the tip is where it shall go: there is nothing to move</source>
            <translation type="unfinished">die Spitze ist schon, wo sie hin soll: Es gibt nichts zu bewegen</translation>
        </message>
        <message>
            <source>{attempts} ways of the tip were found, but the arm's postures along them touch something: begin with another posture or roll</source>
            <translation type="unfinished">gefundene Wege der Spitze: {attempts}, aber auf ihnen berühren die Stellungen des Arms etwas: Beginnen Sie mit einer anderen Stellung oder Drehung</translation>
        </message>
        <message>
            <source>{planner} found no way in {time_perf_counter:.3g} s and {tests} tests (budget {budget_seconds:g} s, {budget_tests} tests, seed {budget_seed}): give it more, or make room</source>
            <translation type="unfinished">{planner} fand in {time_perf_counter:.3g} s und {tests} Tests keinen Weg (Budget {budget_seconds:g} s, {budget_tests} Tests, Startwert {budget_seed}): Geben Sie mehr vor oder schaffen Sie Platz</translation>
        </message>
        <message>
            <source>a scale of {scale} was asked for; it must be in (0, 1]</source>
            <translation type="unfinished">verlangt wurde ein Maßstab von {scale}; er muss in (0, 1] liegen</translation>
        </message>
        <message>
            <source>the path does not move: it has one posture only</source>
            <translation type="unfinished">die Bahn bewegt sich nicht: Sie hat nur eine Stellung</translation>
        </message>
        <message>
            <source>Ruckig finds no motion: {answer}</source>
            <translation type="unfinished">Ruckig findet keine Bewegung: {answer}</translation>
        </message>
        <message>
            <source>the eyes find no tool: {reason}</source>
            <translation type="unfinished">die Augen finden kein Instrument: {reason}</translation>
        </message>
        <message>
            <source>the eyes do not know where the tool lies: {reason}</source>
            <translation type="unfinished">die Augen wissen nicht, wo das Instrument liegt: {reason}</translation>
        </message>
        <message>
            <source>the eyes know the tool's place to {known_mm:.1f} mm only, {sure_mm:g} mm are needed; turn the tool, or move a camera out of its line</source>
            <translation type="unfinished">die Augen kennen den Ort des Instruments nur auf {known_mm:.1f} mm, nötig sind {sure_mm:g} mm; drehen Sie das Instrument oder rücken Sie eine Kamera aus seiner Linie</translation>
        </message>
        <message>
            <source>the eyes find no trocar: {ring_status}; let arm and cameras stand elsewhere round it</source>
            <translation type="unfinished">die Augen finden keinen Trokar: {ring_status}; lassen Sie Arm und Kameras anderswo um ihn herum stehen</translation>
        </message>
        <message>
            <source>the arm would have to insert its tool by {deep_mm:.0f} mm; up to {deepest_mm:.0f} mm it can: choose an entry nearer to the target</source>
            <translation type="unfinished">der Arm müsste sein Instrument {deep_mm:.0f} mm einführen; bis {deepest_mm:.0f} mm kann er: Wählen Sie einen Einstichpunkt näher am Ziel</translation>
        </message>
        <message>
            <source>the path leans {placed_tilt_deg:.0f}° from straight down; the arm inserts up to {flattest_deg:.0f}°: turn the patient, or choose a steeper path</source>
            <translation type="unfinished">der Pfad ist um {placed_tilt_deg:.0f}° gegen die Senkrechte geneigt; der Arm führt bis {flattest_deg:.0f}° ein: Drehen Sie den Patienten oder wählen Sie einen steileren Pfad</translation>
        </message>
        <message>
            <source>insertion: depth is {depth} m; give more than 0</source>
            <translation type="unfinished">Einführen: depth ist {depth} m; geben Sie mehr als 0 an</translation>
        </message>
        <message>
            <source>the path leans {lean:.0f}° from the trocar's axis, which leaves a gap of {gap_mm:.1f} mm round the shaft; {room_mm:g} mm are needed: lay the trocar for this path</source>
            <translation type="unfinished">der Pfad ist um {lean:.0f}° gegen die Achse des Trokars geneigt, das lässt einen Spalt von {gap_mm:.1f} mm um den Schaft; {room_mm:g} mm sind nötig: Legen Sie den Trokar für diesen Pfad</translation>
        </message>
        <message>
            <source>the arm cannot {doing}: {error}; let it stand elsewhere round the entry or choose another path</source>
            <translation type="unfinished">Schritt „{doing}“ gelingt dem Arm nicht: {error}; stellen Sie ihn anderswo um den Einstichpunkt auf oder wählen Sie einen anderen Pfad</translation>
        </message>
        <message>
            <source>the tool is not in the trocar: its axis passes {aside_mm:.1f} mm from the ring's centre, its tip is {depth_mm:.0f} mm beyond it; look again, and grasp the tool anew</source>
            <translation type="unfinished">das Instrument ist nicht im Trokar: Seine Achse geht {aside_mm:.1f} mm an der Ringmitte vorbei, seine Spitze ist {depth_mm:.0f} mm dahinter; schauen Sie noch einmal hin und greifen Sie das Instrument neu</translation>
        </message>
        <message>
            <source>the shaft pressed the trocar's ring with {pressed:.1f} N; up to {allowed:g} N are allowed: look again, or lay the trocar for this path</source>
            <translation type="unfinished">der Schaft drückte mit {pressed:.1f} N auf den Ring des Trokars; bis {allowed:g} N sind erlaubt: Schauen Sie noch einmal hin oder legen Sie den Trokar für diesen Pfad</translation>
        </message>
        <message>
            <source>the tool has fallen: no finger touches it; grasp more firmly</source>
            <translation type="unfinished">das Instrument ist gefallen: Kein Finger berührt es; greifen Sie fester</translation>
        </message>
        <message>
            <source>the tool moved by {moved_mm:.2g} mm and {turned_deg:.2g}° in the hand; up to {slip_mm:g} mm and {slip_turn_deg:g}° are allowed: grasp more firmly</source>
            <translation type="unfinished">das Instrument bewegte sich um {moved_mm:.2g} mm und {turned_deg:.2g}° in der Hand; erlaubt sind {slip_mm:g} mm und {slip_turn_deg:g}°: Greifen Sie fester</translation>
        </message>
        <message>
            <source>scene of the arm: {name} is {length}; give more than 0</source>
            <translation type="unfinished">Szene des Arms: {name} ist {length}; geben Sie mehr als 0 an</translation>
        </message>
        <message>
            <source>scene of the arm: home {home_deg}° is beyond the joint limits ±{limits_deg}°</source>
            <translation type="unfinished">Szene des Arms: home {home_deg}° liegt jenseits der Gelenkgrenzen ±{limits_deg}°</translation>
        </message>
        <message>
            <source>scene of the arm: the trocar at ({x:.0f}, {y:.0f}) mm does not lie on the skin, {on_first_low} to {on_first_high} m</source>
            <translation type="unfinished">Szene des Arms: Der Trokar bei ({x:.0f}, {y:.0f}) mm liegt nicht auf der Haut, {on_first_low} bis {on_first_high} m</translation>
        </message>
        <message>
            <source>timeline of the arm: {name} has shape {values_shape} or is not finite; {count} finite numbers are needed</source>
            <translation type="unfinished">Zeitverlauf des Arms: {name} hat die Form {values_shape} oder ist nicht endlich; {count} endliche Zahlen sind nötig</translation>
        </message>
        <message>
            <source>timeline of the arm: its time must rise, over two moments or more</source>
            <translation type="unfinished">Zeitverlauf des Arms: Seine Zeit muss steigen, über zwei oder mehr Zeitpunkte</translation>
        </message>
        <message>
            <source>timeline of the arm: phase and held need one entry a moment</source>
            <translation type="unfinished">Zeitverlauf des Arms: phase und held brauchen einen Eintrag je Zeitpunkt</translation>
        </message>
        <message>
            <source>timeline of the arm: phases must go through {names} in order</source>
            <translation type="unfinished">Zeitverlauf des Arms: Die Phasen müssen {names} der Reihe nach durchlaufen</translation>
        </message>
        <message>
            <source>the arm has no phase {name!r}; there are {there}</source>
            <translation type="unfinished">der Arm hat keine Phase {name!r}; es gibt {there}</translation>
        </message>
        <message>
            <source>the path takes joint {k} {beyond_max_deg:.3g}° beyond its limits</source>
            <translation type="unfinished">die Bahn führt Gelenk {k} {beyond_max_deg:.3g}° über seine Grenzen hinaus</translation>
        </message>
        <message>
            <source>the hand does not hold the tool after {patience:g} s: {have}</source>
            <translation type="unfinished">die Hand hält das Instrument nach {patience:g} s nicht: {have}</translation>
        </message>
        <message>
            <source>MuJoCo cannot draw without a display here ({error}); install EGL (libegl1), or set MUJOCO_GL=osmesa</source>
            <translation type="unfinished">MuJoCo kann hier ohne Bildschirm nicht zeichnen ({error}); installieren Sie EGL (libegl1) oder setzen Sie MUJOCO_GL=osmesa</translation>
        </message>
        <message>
            <source>the scene of the arm is not open; call open() first</source>
            <translation type="unfinished">die Szene des Arms ist nicht offen; rufen Sie zuerst open() auf</translation>
        </message>
        <message>
            <source>it was loaded for a display, and there is none</source>
            <translation type="unfinished">es wurde für einen Bildschirm geladen, und es gibt keinen</translation>
        </message>
        <message>
            <source>MuJoCo refuses the scene of the arm: {error}</source>
            <translation type="unfinished">MuJoCo weist die Szene des Arms ab: {error}</translation>
        </message>
        <message>
            <source>{kind}, {distance:g} rad</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>searches</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>no fulcrum: {result_status}; turn the tool further</source>
            <translation type="unfinished">kein Drehpunkt: {result_status}; drehen Sie das Instrument weiter</translation>
        </message>
        <message>
            <source>no trocar: {status}</source>
            <translation type="unfinished">kein Trokar: {status}</translation>
        </message>
        <message>
            <source>EAIK is not installed: pip install EAIK, beside Acus</source>
            <translation type="unfinished">EAIK ist nicht installiert: pip install EAIK, neben Acus</translation>
        </message>
        <message>
            <source>What the arm does</source>
            <translation type="unfinished">Was der Arm tut</translation>
        </message>
        <message>
            <source>Pause (Space)</source>
            <translation type="unfinished">Pause (Leertaste)</translation>
        </message>
        <message>
            <source>Step (F10)</source>
            <translation type="unfinished">Schritt (F10)</translation>
        </message>
        <message>
            <source>To the entry (F3)</source>
            <translation type="unfinished">Zum Einstich (F3)</translation>
        </message>
        <message>
            <source>Take over (F12)</source>
            <translation type="unfinished">Übernehmen (F12)</translation>
        </message>
        <message>
            <source>Stop (Esc)</source>
            <translation type="unfinished">Stopp (Esc)</translation>
        </message>
        <message>
            <source>The arm stands still, the needle where it is; or it goes on</source>
            <translation type="unfinished">Der Arm bleibt stehen, die Nadel dort, wo sie ist; oder er macht weiter</translation>
        </message>
        <message>
            <source>The arm goes on for half a second, then stands still</source>
            <translation type="unfinished">Der Arm bewegt sich eine halbe Sekunde weiter und bleibt dann stehen</translation>
        </message>
        <message>
            <source>Leave out the rest of the fetching: the arm stands over the entry</source>
            <translation type="unfinished">Überspringt den Rest des Holens: Der Arm steht dann über dem Einstichpunkt</translation>
        </message>
        <message>
            <source>You go on with mouse or keys from where the needle is now</source>
            <translation type="unfinished">Sie machen mit Maus oder Tasten dort weiter, wo die Nadel jetzt ist</translation>
        </message>
        <message>
            <source>The attempt is broken off; everything is as it was before</source>
            <translation type="unfinished">Der Versuch wird abgebrochen; alles ist wie zuvor</translation>
        </message>
        <message>
            <source>Go on (Space)</source>
            <translation type="unfinished">Weiter (Leertaste)</translation>
        </message>
        <message>
            <source>Simulated arm: robot and cameras are coming …</source>
            <translation type="unfinished">Simulierter Arm: Roboter und Kameras werden gestartet …</translation>
        </message>
        <message>
            <source>Simulated arm: stopping …</source>
            <translation type="unfinished">Simulierter Arm: hält an …</translation>
        </message>
        <message>
            <source>holds still at your target</source>
            <translation type="unfinished">hält still an Ihrem Ziel</translation>
        </message>
        <message>
            <source>Simulated arm: {what}  ·  {now:.0f}/{all:.0f} s</source>
            <translation type="unfinished">Simulierter Arm: {what}  ·  {now:.0f}/{all:.0f} s</translation>
        </message>
        <message>
            <source>Simulated arm  ‖  {what}  ·  {now:.0f}/{all:.0f} s</source>
            <translation type="unfinished">Simulierter Arm  ‖  {what}  ·  {now:.0f}/{all:.0f} s</translation>
        </message>
        <message>
            <source>A simulation only: it drives no real arm and no real robot.</source>
            <translation type="unfinished">Nur eine Simulation: Sie bewegt weder einen echten Arm noch einen echten Roboter.</translation>
        </message>
        <message>
            <source>reaches for the needle guide</source>
            <translation type="unfinished">greift nach der Nadelführung</translation>
        </message>
        <message>
            <source>closes its hand</source>
            <translation type="unfinished">schließt die Hand</translation>
        </message>
        <message>
            <source>lifts the guide off the tray</source>
            <translation type="unfinished">hebt die Führung von der Ablage</translation>
        </message>
        <message>
            <source>brings it to the entry</source>
            <translation type="unfinished">bringt sie zum Einstichpunkt</translation>
        </message>
        <message>
            <source>stands it over the entry</source>
            <translation type="unfinished">stellt sie über den Einstichpunkt</translation>
        </message>
        <message>
            <source>turns the needle to your path</source>
            <translation type="unfinished">richtet die Nadel auf Ihren Pfad aus</translation>
        </message>
        <message>
            <source>inserts along your path</source>
            <translation type="unfinished">führt entlang Ihres Pfads ein</translation>
        </message>
        <message>
            <source>Start waits: the arm has the needle. Esc stops it.</source>
            <translation type="unfinished">Der Start wartet: Der Arm hat die Nadel. Esc hält ihn an.</translation>
        </message>
        <message>
            <source>The arm stopped: another robot or exercise was taken.</source>
            <translation type="unfinished">Der Arm hat angehalten: Ein anderer Roboter oder eine andere Übung wurde gewählt.</translation>
        </message>
        <message>
            <source>The arm stopped: the plan was changed. Ask again for the new one.</source>
            <translation type="unfinished">Der Arm hat angehalten: Der Plan wurde geändert. Fordern Sie ihn für den neuen Plan noch einmal an.</translation>
        </message>
        <message>
            <source>{name}: {answer!r} are not numbers between commas, e.g. 20.5,51,102</source>
            <translation type="unfinished">{name}: {answer!r} sind keine Zahlen zwischen Kommas, z. B. 20.5,51,102</translation>
        </message>
        <message>
            <source>{name}: {count} finite numbers are needed, got {answer!r}</source>
            <translation type="unfinished">{name}: {count} endliche Zahlen sind nötig, gegeben ist {answer!r}</translation>
        </message>
        <message>
            <source>{routine_title}: {report_needs}: give it with --readings</source>
            <translation type="unfinished">{routine_title}: {report_needs}: Geben Sie es mit --readings an</translation>
        </message>
        <message>
            <source>the input has ended before the routine; nothing was kept</source>
            <translation type="unfinished">die Eingabe endete vor der Routine; nichts wurde behalten</translation>
        </message>
        <message>
            <source>--at {place!r} is not {pose}: millimetres and degrees, e.g. -60,180,90,180,0,0</source>
            <translation type="unfinished">--at {place!r} ist nicht {pose}: Millimeter und Grad, z. B. -60,180,90,180,0,0</translation>
        </message>
        <message>
            <source>no calibration is in use: run `acus calibrate stereo --keep` first, or name one with --calibration</source>
            <translation type="unfinished">keine Kalibrierung ist in Gebrauch: Führen Sie zuerst `acus calibrate stereo --keep` aus oder nennen Sie eine mit --calibration</translation>
        </message>
        <message>
            <source>--out takes the lens of one camera; these pictures are of {groups}: give a folder for each, or use `acus calibrate stereo`</source>
            <translation type="unfinished">--out nimmt das Objektiv einer Kamera; diese Bilder sind von {groups}: Geben Sie für jede einen Ordner an oder verwenden Sie `acus calibrate stereo`</translation>
        </message>
        <message>
            <source>name the folder of the pictures: --images DIR</source>
            <translation type="unfinished">nennen Sie den Ordner der Bilder: --images DIR</translation>
        </message>
        <message>
            <source>name the pictures: either --images DIR, or --left and --right</source>
            <translation type="unfinished">nennen Sie die Bilder: entweder --images DIR oder --left und --right</translation>
        </message>
        <message>
            <source>--check-images DIR and --check-board SPEC go together; give both</source>
            <translation type="unfinished">--check-images DIR und --check-board SPEC gehören zusammen; geben Sie beide an</translation>
        </message>
        <message>
            <source>--names {names!r} is not two names, e.g. left,right</source>
            <translation type="unfinished">--names {names!r} sind nicht zwei Namen, z. B. left,right</translation>
        </message>
        <message>
            <source>--format {kind}: only yaml and ros can be written</source>
            <translation type="unfinished">--format {kind}: Nur yaml und ros lassen sich schreiben</translation>
        </message>
        <message>
            <source>--out {out}: only .pdf can be written</source>
            <translation type="unfinished">--out {out}: Nur .pdf lässt sich schreiben</translation>
        </message>
        <message>
            <source>--lens {lens!r}: there are {known_lenses}; equidistant is the fisheye model</source>
            <translation type="unfinished">--lens {lens!r}: Es gibt {known_lenses}; equidistant ist das Fischaugenmodell</translation>
        </message>
        <message>
            <source>{depths!r} is no range of depths; give for example -30,120</source>
            <translation type="unfinished">{depths!r} ist kein Tiefenbereich; geben Sie zum Beispiel -30,120 an</translation>
        </message>
        <message>
            <source>{size!r} is no size of a picture; give for example 640x480</source>
            <translation type="unfinished">{size!r} ist keine Bildgröße; geben Sie zum Beispiel 640x480 an</translation>
        </message>
        <message>
            <source>there is no {side!r} camera; there are {sides}</source>
            <translation type="unfinished">es gibt keine Kamera {side!r}; es gibt {sides}</translation>
        </message>
        <message>
            <source>the cameras are simulated and have no latency to measure; choose real ones with `acus camera use`</source>
            <translation type="unfinished">die Kameras sind simuliert und haben keine messbare Latenz; wählen Sie echte mit `acus camera use`</translation>
        </message>
        <message>
            <source>the test needs a real screen that a camera can look at; there is none</source>
            <translation type="unfinished">der Test braucht einen echten Bildschirm, den eine Kamera sehen kann; es gibt keinen</translation>
        </message>
        <message>
            <source>name a point: either --voxel I,J,K, or --sop UID with --pixel COL,ROW</source>
            <translation type="unfinished">nennen Sie einen Punkt: entweder --voxel I,J,K oder --sop UID mit --pixel COL,ROW</translation>
        </message>
        <message>
            <source>--frame {frame}: frames count from 1 and go with --sop UID</source>
            <translation type="unfinished">--frame {frame}: Bilder zählen ab 1 und gehören zu --sop UID</translation>
        </message>
        <message>
            <source>--remedy goes with --voxel; a pixel lies where its file puts it</source>
            <translation type="unfinished">--remedy gehört zu --voxel; ein Pixel liegt dort, wo seine Datei es hinlegt</translation>
        </message>
        <message>
            <source>--sop UID and --pixel COL,ROW go together; give both</source>
            <translation type="unfinished">--sop UID und --pixel COL,ROW gehören zusammen; geben Sie beide an</translation>
        </message>
        <message>
            <source>{option} {point!r}: three numbers X,Y,Z in mm</source>
            <translation type="unfinished">{option} {point!r}: drei Zahlen X,Y,Z in mm</translation>
        </message>
        <message>
            <source>--remedy {remedy!r} is none of {valid}</source>
            <translation type="unfinished">--remedy {remedy!r} ist keines von {valid}</translation>
        </message>
        <message>
            <source>--mask {mask!r} is not COL,ROW,WIDTH,HEIGHT or COL,ROW,WIDTH,HEIGHT,PICTURE: four or five whole numbers, no blanks</source>
            <translation type="unfinished">--mask {mask!r} ist nicht COL,ROW,WIDTH,HEIGHT oder COL,ROW,WIDTH,HEIGHT,PICTURE: vier oder fünf ganze Zahlen, keine Leerzeichen</translation>
        </message>
        <message>
            <source>voxel {ijk} is outside the series: {limits}</source>
            <translation type="unfinished">Voxel {ijk} liegt außerhalb der Serie: {limits}</translation>
        </message>
        <message>
            <source>{option} {argument!r} is not {form}: {count} whole numbers, no blanks</source>
            <translation type="unfinished">{option} {argument!r} ist nicht {form}: {count} ganze Zahlen, keine Leerzeichen</translation>
        </message>
        <message>
            <source>the robot was greeted but sends no joint angles; see `acus device test`</source>
            <translation type="unfinished">der Roboter hat geantwortet, sendet aber keine Gelenkwinkel; siehe `acus device test`</translation>
        </message>
        <message>
            <source>--ct DIR needs --plan FILE: entry and target lie in that CT</source>
            <translation type="unfinished">--ct DIR braucht --plan FILE: Einstichpunkt und Ziel liegen in jenem CT</translation>
        </message>
        <message>
            <source>there is no script {script!r}; there are {scripts}</source>
            <translation type="unfinished">es gibt kein Skript {script!r}; es gibt {scripts}</translation>
        </message>
        <message>
            <source>--target {target}: three numbers X,Y,Z in mm are needed</source>
            <translation type="unfinished">--target {target}: Drei Zahlen X,Y,Z in mm sind nötig</translation>
        </message>
        <message>
            <source>{form}: the forms are {forms}</source>
            <translation type="unfinished">{form}: Die Formen sind {forms}</translation>
        </message>
        <message>
            <source>--student is for pdf; the tables hold everybody</source>
            <translation type="unfinished">--student gilt für pdf; die Tabellen enthalten alle</translation>
        </message>
        <message>
            <source>--ct {ct} does not exist; name a folder or file with a CT</source>
            <translation type="unfinished">--ct {ct} gibt es nicht; nennen Sie einen Ordner oder eine Datei mit einem CT</translation>
        </message>
        <message>
            <source>--out {out}: only .csv can be written</source>
            <translation type="unfinished">--out {out}: Nur .csv lässt sich schreiben</translation>
        </message>
        <message>
            <source>--trajectory takes exactly one session id</source>
            <translation type="unfinished">--trajectory verlangt genau eine Sitzungskennung</translation>
        </message>
        <message>
            <source>study {name} takes no --{option}; leave it out</source>
            <translation type="unfinished">die Studie {name} kennt kein --{option}; lassen Sie es weg</translation>
        </message>
        <message>
            <source>--orientation {orientation!r}: use {valid}</source>
            <translation type="unfinished">--orientation {orientation!r}: Verwenden Sie {valid}</translation>
        </message>
        <message>
            <source>--origin {origin!r}; valid names: {names}</source>
            <translation type="unfinished">--origin {origin!r}; gültige Namen: {names}</translation>
        </message>
        <message>
            <source>--out {out}: a device profile is a .yaml file</source>
            <translation type="unfinished">--out {out}: Ein Geräteprofil ist eine .yaml-Datei</translation>
        </message>
        <message>
            <source>exercise {name} has no CT in Hounsfield values: nothing tells what its needle meets</source>
            <translation type="unfinished">Übung {name} hat kein CT in Hounsfield-Werten: Nichts sagt, worauf ihre Nadel trifft</translation>
        </message>
        <message>
            <source>the cameras are simulated; choose real ones with `acus camera use --left SOURCE --right SOURCE`, or look at one with --source</source>
            <translation type="unfinished">die Kameras sind simuliert; wählen Sie echte mit `acus camera use --left SOURCE --right SOURCE` oder sehen Sie sich mit --source eine an</translation>
        </message>
        <message>
            <source>left and right are not checked: there is no calibration yet (`acus calibrate`)</source>
            <translation type="unfinished">links und rechts sind nicht geprüft: Es gibt noch keine Kalibrierung (`acus calibrate`)</translation>
        </message>
        <message>
            <source>rig {rig_name} as designed</source>
            <translation type="unfinished">Kameraaufbau {rig_name} wie entworfen</translation>
        </message>
        <message>
            <source>calibration {name}</source>
            <translation type="unfinished">Kalibrierung {name}</translation>
        </message>
        <message>
            <source>{basis}; the cameras are not calibrated with a world frame yet</source>
            <translation type="unfinished">{basis}; die Kameras sind noch nicht mit einem Weltkoordinatensystem kalibriert</translation>
        </message>
        <message>
            <source>the cameras are not calibrated: run `acus calibrate stereo` and `acus calibrate world`, or choose the calibration in the window's menu Cameras</source>
            <translation type="unfinished">die Kameras sind nicht kalibriert: Führen Sie `acus calibrate stereo` und `acus calibrate world` aus oder wählen Sie die Kalibrierung im Menü Kameras des Fensters</translation>
        </message>
        <message>
            <source>calibration {calibration_id} was found bad ({reason}); calibrate again, or choose another one in the camera settings</source>
            <translation type="unfinished">Kalibrierung {calibration_id} wurde für schlecht befunden ({reason}); kalibrieren Sie neu oder wählen Sie eine andere in den Kameraeinstellungen</translation>
        </message>
        <message>
            <source>the check is not open: call open() first</source>
            <translation type="unfinished">die Kontrolle ist nicht offen; rufen Sie zuerst open() auf</translation>
        </message>
        <message>
            <source>plate {plate_name} has no known place in the robot's frame; give `place` in its file</source>
            <translation type="unfinished">Platte {plate_name} hat keinen bekannten Ort im Koordinatensystem des Roboters; geben Sie `place` in ihrer Datei an</translation>
        </message>
        <message>
            <source>view {name!r} is declared twice: {files} and {path}</source>
            <translation type="unfinished">Ansicht {name!r} ist zweimal deklariert: {files} und {path}</translation>
        </message>
        <message>
            <source>asking the camera for its first picture</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>computing what the cameras see of the needle's cone</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>asking the webcam for its first picture</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>compiling the loop</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>starting robot and cameras</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>the control loop has not ticked in {waited:.0f} s; start it again</source>
            <translation type="unfinished">die Regelschleife hat seit {waited:.0f} s nicht getaktet; starten Sie sie neu</translation>
        </message>
        <message>
            <source>exercise {exercise_id} has no effect {effect!r}; it has {exercise_effects}</source>
            <translation type="unfinished">Übung {exercise_id} hat keinen Effekt {effect!r}; sie hat {exercise_effects}</translation>
        </message>
        <message>
            <source>effect {effect} acts on the pictures of cameras that are running: choose its model in the exercise, before the attempt</source>
            <translation type="unfinished">Effekt {effect} wirkt auf die Bilder laufender Kameras: Wählen Sie sein Modell in der Übung, vor dem Versuch</translation>
        </message>
        <message>
            <source>{link} exists and is not a link; choose another --link</source>
            <translation type="unfinished">{link} gibt es schon und ist kein Link; wählen Sie ein anderes --link</translation>
        </message>
        <message>
            <source>no link can be made in {link_parent}; choose another --link</source>
            <translation type="unfinished">in {link_parent} lässt sich kein Link anlegen; wählen Sie ein anderes --link</translation>
        </message>
        <message>
            <source>this system has no pseudo-terminals (Windows): the emulated board runs on Linux</source>
            <translation type="unfinished">dieses System hat keine Pseudoterminals (Windows): Die emulierte Platine läuft unter Linux</translation>
        </message>
        <message>
            <source>no hand {name!r}; valid names: {hands}</source>
            <translation type="unfinished">keine Hand {name!r}; gültige Namen: {hands}</translation>
        </message>
        <message>
            <source>{order!r} is not understood; valid are: hold on|off, turn left|right DEGREES, lean X Y (degrees towards x and y)</source>
            <translation type="unfinished">{order!r} wird nicht verstanden; gültig sind: hold on|off, turn left|right DEGREES, lean X Y (Grad nach x und y)</translation>
        </message>
        <message>
            <source>the needle would lean by more than {largest_tilt:g} degrees; turn by less</source>
            <translation type="unfinished">die Nadel wäre um mehr als {largest_tilt:g} Grad geneigt; drehen Sie um weniger</translation>
        </message>
        <message>
            <source>{angle!r} is no number of degrees</source>
            <translation type="unfinished">{angle!r} ist keine Gradzahl</translation>
        </message>
        <message>
            <source>{angle} degrees is too much; give at most {largest_tilt:g}</source>
            <translation type="unfinished">{angle} Grad sind zu viel; geben Sie höchstens {largest_tilt:g} an</translation>
        </message>
        <message>
            <source>no hand {hand!r}; valid names: {hands}</source>
            <translation type="unfinished">keine Hand {hand!r}; gültige Namen: {hands}</translation>
        </message>
        <message>
            <source>no fault or order {name!r}; valid names: {valid}</source>
            <translation type="unfinished">keine Störung und kein Befehl {name!r}; gültig sind: {valid}</translation>
        </message>
        <message>
            <source>fault {name} needs a number, e.g. `{name} 1`</source>
            <translation type="unfinished">Störung {name} braucht eine Zahl, z. B. `{name} 1`</translation>
        </message>
        <message>
            <source>fault {name}: {setting!r} is no number, on or off</source>
            <translation type="unfinished">Störung {name}: {setting!r} ist keine Zahl und nicht on oder off</translation>
        </message>
        <message>
            <source>exercise {exercise_id} has structures of risk, and no CT to place them on: open it</source>
            <translation type="unfinished">Übung {exercise_id} hat Risikostrukturen, aber kein CT, auf dem sie liegen: Öffnen Sie es</translation>
        </message>
        <message>
            <source>layers: the exercise has them</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>the field: the exercise asks for it</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>exercise {exercise_id} has tissue: field, and its CT is not open, or its values are no Hounsfield values: open its CT, or set tissue: layers</source>
            <translation type="unfinished">Übung {exercise_id} hat tissue: field, aber ihr CT ist nicht offen, oder seine Werte sind keine Hounsfield-Werte: Öffnen Sie ihr CT oder setzen Sie tissue: layers</translation>
        </message>
        <message>
            <source>layers: there is no CT in Hounsfield values</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>this record cannot be replayed: it has no {tissue_file}</source>
            <translation type="unfinished">diese Aufzeichnung lässt sich nicht wiedergeben: Ihr fehlt {tissue_file}</translation>
        </message>
        <message>
            <source>this record cannot be replayed: {tissue_file} is {field_digest}, and it was made with {recorded_digest}</source>
            <translation type="unfinished">diese Aufzeichnung lässt sich nicht wiedergeben: {tissue_file} ist {field_digest}, gemacht wurde sie mit {recorded_digest}</translation>
        </message>
        <message>
            <source>nothing is called for: a tool in a trocar moves in an inflated belly</source>
            <translation type="unfinished">nichts ist gefordert: Ein Instrument in einem Trokar bewegt sich in einem aufgeblasenen Bauch</translation>
        </message>
        <message>
            <source>nothing is called for: there is no CT in Hounsfield units</source>
            <translation type="unfinished">nichts ist gefordert: Es gibt kein CT in Hounsfield-Einheiten</translation>
        </message>
        <message>
            <source>the first start compiles what follows the marker</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{tissue}: the loop had it, the walk had not</source>
            <translation type="unfinished">{tissue}: in der Regelschleife ja, im Durchgang nicht</translation>
        </message>
        <message>
            <source>{tissue}: the walk had it, the loop had not</source>
            <translation type="unfinished">{tissue}: im Durchgang ja, in der Regelschleife nicht</translation>
        </message>
        <message>
            <source>{declared_path} has no function preview(): it has no page</source>
            <translation type="unfinished">{declared_path} hat keine Funktion preview(): Es hat keine Seite</translation>
        </message>
        <message>
            <source>a simulated pen has no tip to measure; give --source usb:0</source>
            <translation type="unfinished">ein simulierter Stift hat keine Spitze zum Vermessen; geben Sie --source usb:0 an</translation>
        </message>
        <message>
            <source>machines</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{path} must define FEATURE, a class of Feature; see 'How to add a panel'</source>
            <translation type="unfinished">{path} muss FEATURE definieren, eine Klasse von Feature; siehe „How to add a panel“</translation>
        </message>
        <message>
            <source>{path}: after is {declared_get!r}; valid are {names}</source>
            <translation type="unfinished">{path}: after ist {declared_get!r}; gültig sind {names}</translation>
        </message>
        <message>
            <source>loading the routines</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>greeting the board</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>waiting for joint angles</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>the robot at {port} was greeted but sends no joint angles; see `acus device test {port}`</source>
            <translation type="unfinished">der Roboter an {port} hat geantwortet, sendet aber keine Gelenkwinkel; siehe `acus device test {port}`</translation>
        </message>
        <message>
            <source>exercise {exercise_id} has tissue: {exercise_tissue}, and its field has not been made: make it first, or set tissue: layers</source>
            <translation type="unfinished">Übung {exercise_id} hat tissue: {exercise_tissue}, und ihr Feld wurde nicht erstellt: Erstellen Sie es zuerst oder setzen Sie tissue: layers</translation>
        </message>
        <message>
            <source>this needs the two cameras of a robot; {noun} has none</source>
            <translation type="unfinished">dies braucht die zwei Kameras eines Roboters; {noun} hat keine</translation>
        </message>
        <message>
            <source>{noun} has no robot that could push: no effect is computed</source>
            <translation type="unfinished">{noun} hat keinen Roboter, der drücken könnte: Kein Effekt wird berechnet</translation>
        </message>
        <message>
            <source>effect {effect} is not simulated in {exercise_id}: nobody needs what it gives; `acus explain {exercise_id}` says why</source>
            <translation type="unfinished">Effekt {effect} wird in {exercise_id} nicht simuliert: Niemand braucht, was er gibt; `acus explain {exercise_id}` sagt, warum</translation>
        </message>
        <message>
            <source>this record cannot be replayed: it has no {name}</source>
            <translation type="unfinished">diese Aufzeichnung lässt sich nicht wiedergeben: Ihr fehlt {name}</translation>
        </message>
        <message>
            <source>this record cannot be replayed: {name} is damaged: {error}</source>
            <translation type="unfinished">diese Aufzeichnung lässt sich nicht wiedergeben: {name} ist beschädigt: {error}</translation>
        </message>
        <message>
            <source>this record cannot be replayed: its seed is {seed!r}</source>
            <translation type="unfinished">diese Aufzeichnung lässt sich nicht wiedergeben: Ihr Startwert ist {seed!r}</translation>
        </message>
        <message>
            <source>{name} has shape {array_shape}; {shape} is needed</source>
            <translation type="unfinished">{name} hat die Form {array_shape}; {shape} ist nötig</translation>
        </message>
        <message>
            <source>{name} {array} has no direction</source>
            <translation type="unfinished">{name} {array} hat keine Richtung</translation>
        </message>
        <message>
            <source>a number is needed</source>
            <translation type="unfinished">eine Zahl ist nötig</translation>
        </message>
        <message>
            <source>cannot read {path}: {error_strerror}</source>
            <translation type="unfinished">{path} lässt sich nicht lesen: {error_strerror}</translation>
        </message>
        <message>
            <source>{path} is not valid YAML: {line}</source>
            <translation type="unfinished">{path} ist kein gültiges YAML: {line}</translation>
        </message>
        <message>
            <source>{origin} is not valid YAML: it is nested too deeply</source>
            <translation type="unfinished">{origin} ist kein gültiges YAML: Es ist zu tief verschachtelt</translation>
        </message>
        <message>
            <source>{origin} is not valid YAML: {line}</source>
            <translation type="unfinished">{origin} ist kein gültiges YAML: {line}</translation>
        </message>
        <message>
            <source>{origin}: {faults}</source>
            <translation type="unfinished">{origin}: {faults}</translation>
        </message>
        <message>
            <source>{package} is not installed; install the extra `{extra}`: {install_command}</source>
            <translation type="unfinished">{package} ist nicht installiert; installieren Sie das Extra `{extra}`: {install_command}</translation>
        </message>
        <message>
            <source>its packages stand in pyproject.toml</source>
            <translation type="unfinished">seine Pakete stehen in pyproject.toml</translation>
        </message>
        <message>
            <source>waiting {waited:.0f} s for the program to load (the first start after an installation compiles, for a minute or two)</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>loading</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{group} has no field {unknown}; it has {places_fields}</source>
            <translation type="unfinished">{group} hat kein Feld {unknown}; es hat {places_fields}</translation>
        </message>
        <message>
            <source>{group} needs {missing} as well</source>
            <translation type="unfinished">{group} braucht auch {missing}</translation>
        </message>
        <message>
            <source>{folder} cannot be read: {reason}</source>
            <translation type="unfinished">{folder} lässt sich nicht lesen: {reason}</translation>
        </message>
        <message>
            <source>: {folder} has that name</source>
            <translation type="unfinished">: {folder} heißt schon so</translation>
        </message>
        <message>
            <source>{folder}: there is no such folder</source>
            <translation type="unfinished">{folder}: Diesen Ordner gibt es nicht</translation>
        </message>
        <message>
            <source>{name!r} is no package that can be imported{taken}: a folder of plug-ins has an __init__.py and a name of its own that is a Python name</source>
            <translation type="unfinished">{name!r} ist kein importierbares Paket{taken}: Ein Ordner mit Plug-ins hat eine __init__.py und einen eigenen Namen, der ein Python-Name ist</translation>
        </message>
        <message>
            <source>{name} is {setting:g} {parameters_unit}; published are {known_least:g} to {known_most:g} ({known_source})</source>
            <translation type="unfinished">{name} ist {setting:g} {parameters_unit}; veröffentlicht sind {known_least:g} bis {known_most:g} ({known_source})</translation>
        </message>
        <message>
            <source>there is no {kind} {name!r}; there are {known}</source>
            <translation type="unfinished">{kind} {name!r} gibt es nicht; es gibt {known}</translation>
        </message>
        <message>
            <source>two files are the {noun} {name!r}: {first} and {second}; rename one</source>
            <translation type="unfinished">zwei Dateien sind {noun} {name!r}: {first} und {second}; benennen Sie eine um</translation>
        </message>
        <message>
            <source>{kind} file {path} cannot be read: {reason}</source>
            <translation type="unfinished">{kind}: Die Datei {path} lässt sich nicht lesen: {reason}</translation>
        </message>
        <message>
            <source>{path}: {name!r} is a name of the program's own; rename the file</source>
            <translation type="unfinished">{path}: {name!r} ist ein Name des Programms selbst; benennen Sie die Datei um</translation>
        </message>
        <message>
            <source>{kind} file {path} cannot be imported: {fault}</source>
            <translation type="unfinished">{kind}: Die Datei {path} lässt sich nicht importieren: {fault}</translation>
        </message>
        <message>
            <source>{path}: {doing}: {fault}</source>
            <translation type="unfinished">{path}: {doing}: {fault}</translation>
        </message>
        <message>
            <source>{kind} file {declared_path} cannot be imported: {fault}</source>
            <translation type="unfinished">{kind}: Die Datei {declared_path} lässt sich nicht importieren: {fault}</translation>
        </message>
        <message>
            <source>it is no Python file</source>
            <translation type="unfinished">keine Python-Datei</translation>
        </message>
        <message>
            <source>{path} has no {name} = {{...}}; see 'How to add {kind_noun}'</source>
            <translation type="unfinished">{path} hat kein {name} = {{...}}; siehe „How to add {kind_noun}“</translation>
        </message>
        <message>
            <source>{path}, line {line}: {name} must have exactly the keys {kind_fields}{may}; check {differing}</source>
            <translation type="unfinished">{path}, Zeile {line}: {name} muss genau die Schlüssel {kind_fields} haben{may}; prüfen Sie {differing}</translation>
        </message>
        <message>
            <source>{path} has no function {function}(); see 'How to add {kind_noun}'</source>
            <translation type="unfinished">{path} hat keine Funktion {function}(); siehe „How to add {kind_noun}“</translation>
        </message>
        <message>
            <source>{path}, line {line}: published names {unknown_name!r}, which is no parameter; it has {parameters}</source>
            <translation type="unfinished">{path}, Zeile {line}: „published“ nennt {unknown_name!r}, das kein Parameter ist; vorhanden: {parameters}</translation>
        </message>
        <message>
            <source>{path}, line {node_lineno}: {name} is not a literal: {reason}</source>
            <translation type="unfinished">{path}, Zeile {node_lineno}: {name} ist kein Literal: {reason}</translation>
        </message>
        <message>
            <source>{path}, line {line}: {fault}; give {wanted_valid}</source>
            <translation type="unfinished">{path}, Zeile {line}: {fault}; gültig ist: {wanted_valid}</translation>
        </message>
        <message>
            <source>{path}, line {line}: {key} is {setting!r}; give {wanted_valid}</source>
            <translation type="unfinished">{path}, Zeile {line}: {key} ist {setting!r}; gültig ist: {wanted_valid}</translation>
        </message>
        <message>
            <source>{name!r} is not a slot of core.state_vector{hint}</source>
            <translation type="unfinished">{name!r} ist kein Platz in core.state_vector{hint}</translation>
        </message>
        <message>
            <source>{strange} is the loop's own</source>
            <translation type="unfinished">{strange} gehört der Regelschleife selbst</translation>
        </message>
        <message>
            <source>parameter {name!r}</source>
            <translation type="unfinished">Parameter {name!r}</translation>
        </message>
        <message>
            <source>parameter {name!r} is {row!r}</source>
            <translation type="unfinished">Parameter {name!r} ist {row!r}</translation>
        </message>
        <message>
            <source>published {name!r}</source>
            <translation type="unfinished">published {name!r}</translation>
        </message>
        <message>
            <source>published {name!r} is {row!r}</source>
            <translation type="unfinished">published {name!r} ist {row!r}</translation>
        </message>
        <message>
            <source>published {name!r} is {least:g} to {most:g}, and {measured:g} was measured, which lies outside</source>
            <translation type="unfinished">published {name!r} reicht von {least:g} bis {most:g}; gemessen wurde {measured:g}, also außerhalb</translation>
        </message>
        <message>
            <source>{owner} has no parameter {unknown_name!r}; it has {declared_parameters}</source>
            <translation type="unfinished">{owner} hat keinen Parameter {unknown_name!r}; vorhanden: {declared_parameters}</translation>
        </message>
        <message>
            <source>{declared_path}: {name} takes {limit_default!r} from the device profile, which has no such field</source>
            <translation type="unfinished">{declared_path}: {name} übernimmt {limit_default!r} aus dem Geräteprofil, das kein solches Feld hat</translation>
        </message>
        <message>
            <source>{owner} needs {name} [{limit_unit}]: {limit_meaning}</source>
            <translation type="unfinished">{owner} braucht {name} [{limit_unit}]: {limit_meaning}</translation>
        </message>
        <message>
            <source>{owner}: {name} is {setting!r}; give {limit_minimum:g} to {limit_maximum:g} {limit_unit}</source>
            <translation type="unfinished">{owner}: {name} ist {setting!r}; gültig sind {limit_minimum:g} bis {limit_maximum:g} {limit_unit}</translation>
        </message>
        <message>
            <source>state_vector: the input at place {slot} stands below a slot that is none; move its line up among the inputs</source>
            <translation type="unfinished">state_vector: Der Eingang auf Platz {slot} steht unter einem Platz, der keiner ist; verschieben Sie seine Zeile nach oben zu den Eingängen</translation>
        </message>
        <message>
            <source>state_vector: INPUTS does not stand directly below the last input</source>
            <translation type="unfinished">state_vector: INPUTS steht nicht direkt unter dem letzten Eingang</translation>
        </message>
        <message>
            <source>state_vector: the parts of a vector lie at the places {slots}; put their lines one below the other, in the order x, y, z or left, right</source>
            <translation type="unfinished">state_vector: Die Teile eines Vektors liegen auf den Plätzen {slots}; setzen Sie ihre Zeilen untereinander, in der Reihenfolge x, y, z oder left, right</translation>
        </message>
        <message>
            <source>rotation {rotation} is not orthonormal</source>
            <translation type="unfinished">die Rotation {rotation} ist nicht orthonormal</translation>
        </message>
        <message>
            <source>rotation {rotation} is a reflection</source>
            <translation type="unfinished">die Rotation {rotation} ist eine Spiegelung</translation>
        </message>
        <message>
            <source>last row of a rigid transform is {array}</source>
            <translation type="unfinished">die letzte Zeile einer starren Transformation ist {array}</translation>
        </message>
        <message>
            <source>the bench is closed; open it first</source>
            <translation type="unfinished">der Messplatz ist geschlossen; öffnen Sie ihn zuerst</translation>
        </message>
        <message>
            <source>the bench was not opened; open it first</source>
            <translation type="unfinished">der Messplatz wurde nicht geöffnet; öffnen Sie ihn zuerst</translation>
        </message>
        <message>
            <source>{step} needs the device to be homed since it was switched on; run `--step homing` first</source>
            <translation type="unfinished">{step} setzt voraus, dass das Gerät seit dem Einschalten referenziert wurde; führen Sie zuerst `--step homing` aus</translation>
        </message>
        <message>
            <source>{step} pushes, so the signs must be checked since the device was switched on; run `--step signs` first</source>
            <translation type="unfinished">{step} übt Kraft aus, daher müssen die Vorzeichen seit dem Einschalten geprüft worden sein; führen Sie zuerst `--step signs` aus</translation>
        </message>
        <message>
            <source>{title}: {reason}</source>
            <translation type="unfinished">{title}: {reason}</translation>
        </message>
        <message>
            <source>{title}: the force would point along the needle, where the robot cannot push; hold the needle upright</source>
            <translation type="unfinished">{title}: Die Kraft würde entlang der Nadel wirken, wo der Roboter nicht drücken kann; halten Sie die Nadel senkrecht</translation>
        </message>
        <message>
            <source>Force scale: {readings} readings for {forces} forces; give one reading in grams for each</source>
            <translation type="unfinished">Kraftmaßstab: Messwerte: {readings}, Kräfte: {forces}; geben Sie zu jeder Kraft einen Messwert in Gramm an</translation>
        </message>
        <message>
            <source>Force scale: the readings {grams} g are not all numbers; weigh again</source>
            <translation type="unfinished">Kraftmaßstab: Die Messwerte {grams} g sind nicht alle Zahlen; wiegen Sie noch einmal</translation>
        </message>
        <message>
            <source>measured over commanded force is {factor:.3f}</source>
            <translation type="unfinished">gemessene durch befohlene Kraft ist {factor:.3f}</translation>
        </message>
        <message>
            <source>the readings scatter by {residual:.3f} N about a line (at most {largest_residual:g} N): tare the scale, keep the needle still, and weigh again</source>
            <translation type="unfinished">die Messwerte streuen um {residual:.3f} N um eine Gerade (höchstens {largest_residual:g} N): Stellen Sie die Waage auf null, halten Sie die Nadel ruhig und wiegen Sie noch einmal</translation>
        </message>
        <message>
            <source>the scale does not feel the robot; check thread, tare and motor supply</source>
            <translation type="unfinished">die Waage spürt den Roboter nicht; prüfen Sie Faden, Nullstellung und Motorversorgung</translation>
        </message>
        <message>
            <source>the sign is wrong; check the direction of the set-up, then the signs</source>
            <translation type="unfinished">das Vorzeichen ist falsch; prüfen Sie die Richtung des Aufbaus, dann die Vorzeichen</translation>
        </message>
        <message>
            <source>the gear ratio {gear:g}:1 seems to be missing in the torque factor: the board takes the joint torque for the motor shaft's; divide its torque factor by the gear ratio</source>
            <translation type="unfinished">die Übersetzung {gear:g}:1 scheint im Drehmomentfaktor zu fehlen: Die Platine hält das Gelenkmoment für das der Motorwelle; teilen Sie ihren Drehmomentfaktor durch die Übersetzung</translation>
        </message>
        <message>
            <source>the gear ratio {gear:g}:1 seems to be applied twice; multiply the board's torque factor by the gear ratio</source>
            <translation type="unfinished">die Übersetzung {gear:g}:1 scheint doppelt angewandt zu sein; multiplizieren Sie den Drehmomentfaktor der Platine mit der Übersetzung</translation>
        </message>
        <message>
            <source>check torque constant, amplifier gain and lengths in the profile against the device</source>
            <translation type="unfinished">vergleichen Sie Drehmomentkonstante, Verstärkung und Längen im Profil mit dem Gerät</translation>
        </message>
        <message>
            <source>{title}: the board measures no force; connect the gauge's amplifier, or leave this step out: forces are then shown as estimated</source>
            <translation type="unfinished">{title}: Die Platine misst keine Kraft; schließen Sie den Verstärker des Kraftmessers an oder lassen Sie diesen Schritt weg: Die Kräfte werden dann als geschätzt angezeigt</translation>
        </message>
        <message>
            <source>Gauge calibration: give one reading for each of at least two different weights</source>
            <translation type="unfinished">Kalibrierung des Kraftmessers: Geben Sie für mindestens zwei verschiedene Gewichte je einen Messwert an</translation>
        </message>
        <message>
            <source>Gauge calibration: a reading is not a number; read again</source>
            <translation type="unfinished">Kalibrierung des Kraftmessers: Ein Messwert ist keine Zahl; lesen Sie noch einmal ab</translation>
        </message>
        <message>
            <source>Gauge calibration: the reading changes by {slope:.3f} N per newton (valid {least_scale:g} to {largest_scale:g}): check the amplifier's gain and polarity, and which way the weights pull</source>
            <translation type="unfinished">Kalibrierung des Kraftmessers: Der Messwert ändert sich um {slope:.3f} N je Newton (gültig {least_scale:g} bis {largest_scale:g}): Prüfen Sie Verstärkung und Polung des Verstärkers und in welche Richtung die Gewichte ziehen</translation>
        </message>
        <message>
            <source>Gauge calibration: the readings lie {residual:.2f} N off a line (at most {gauge_residual:g} N): let the weights hang still and free</source>
            <translation type="unfinished">Kalibrierung des Kraftmessers: Die Messwerte liegen {residual:.2f} N neben einer Geraden (höchstens {gauge_residual:g} N): Lassen Sie die Gewichte ruhig und frei hängen</translation>
        </message>
        <message>
            <source>{title}: the {side} joint does not move up to {largest:g} N·m; let go of the needle, or look for what rubs</source>
            <translation type="unfinished">{title}: Das Gelenk ({side}) bewegt sich bis {largest:g} N·m nicht; lassen Sie die Nadel los, oder suchen Sie, was reibt</translation>
        </message>
        <message>
            <source>{title}: the {side} joint does not keep {speed:g} rad/s with {largest:g} N·m; take the needle out, or look for what rubs</source>
            <translation type="unfinished">{title}: Das Gelenk ({side}) hält {speed:g} rad/s mit {largest:g} N·m nicht; nehmen Sie die Nadel heraus, oder suchen Sie, was reibt</translation>
        </message>
        <message>
            <source>too few readings while the joint moved; is the link slow?</source>
            <translation type="unfinished">zu wenige Messwerte, während sich das Gelenk bewegte; ist die Verbindung langsam?</translation>
        </message>
        <message>
            <source>Friction: the joint moved at once, without a ramp; is the torque factor far too large?</source>
            <translation type="unfinished">Reibung: Das Gelenk bewegte sich sofort, ohne Rampe; ist der Drehmomentfaktor viel zu groß?</translation>
        </message>
        <message>
            <source>move both links outwards against their stops (left {left:.1f}°, right {right:.1f}°), hold them there and confirm</source>
            <translation type="unfinished">bewegen Sie beide Glieder nach außen bis an die Anschläge (links {left:.1f}°, rechts {right:.1f}°), halten Sie sie dort und bestätigen Sie</translation>
        </message>
        <message>
            <source>{title}: with the needle upright the angles give a tilt of {tilt:.0f}° (at most {upright_deg:g}° by eye); an encoder counts the wrong way or not at all, the reference pose was not reached, or counts_per_turn ({encoder_counts_per_turn}) is wrong</source>
            <translation type="unfinished">{title}: Bei senkrechter Nadel ergeben die Winkel eine Neigung von {tilt:.0f}° (nach Augenmaß höchstens {upright_deg:g}°); ein Encoder zählt falsch herum oder gar nicht, die Referenzstellung wurde nicht erreicht, oder counts_per_turn ({encoder_counts_per_turn}) ist falsch</translation>
        </message>
        <message>
            <source>{title}: {pose} (left {left:.1f}°, right {right:.1f}°) is none that the links can take: {error}; check home_offsets and the link lengths</source>
            <translation type="unfinished">{title}: {pose} (links {left:.1f}°, rechts {right:.1f}°) ist eine Stellung, die die Glieder nicht einnehmen können: {error}; prüfen Sie home_offsets und die Längen der Glieder</translation>
        </message>
        <message>
            <source>put the needle into the jig that holds it vertical and confirm</source>
            <translation type="unfinished">setzen Sie die Nadel in die Lehre, die sie senkrecht hält, und bestätigen Sie</translation>
        </message>
        <message>
            <source>{title}: the angles give a tilt of {tilt:.0f}°, the ball joint allows {limit:g}°; an encoder counts the wrong way, or the jig is not vertical</source>
            <translation type="unfinished">{title}: Die Winkel ergeben eine Neigung von {tilt:.0f}°, das Kugelgelenk erlaubt {limit:g}°; ein Encoder zählt falsch herum, oder die Lehre ist nicht senkrecht</translation>
        </message>
        <message>
            <source>{title}: </source>
            <translation type="unfinished">{title}: </translation>
        </message>
        <message>
            <source>{title}: {problem}</source>
            <translation type="unfinished">{title}: {problem}</translation>
        </message>
        <message>
            <source>no encoder saw the {side} link move (at least {turn_deg:.0f}° were asked for): check the encoder's cable and supply</source>
            <translation type="unfinished">kein Encoder hat eine Bewegung des Glieds ({side}) gesehen (verlangt waren mindestens {turn_deg:.0f}°): Prüfen Sie Kabel und Versorgung des Encoders</translation>
        </message>
        <message>
            <source>the other encoder moved more when the {side} link was turned: the encoders of left and right are swapped (exchange their plugs), or the wrong link was turned</source>
            <translation type="unfinished">als das Glied ({side}) gedreht wurde, bewegte sich der andere Encoder mehr: Die Encoder links und rechts sind vertauscht (tauschen Sie ihre Stecker), oder es wurde das falsche Glied gedreht</translation>
        </message>
        <message>
            <source>the {side} encoder counts backwards: exchange its channels A and B, or reverse it in the board's settings</source>
            <translation type="unfinished">der Encoder ({side}) zählt rückwärts: Tauschen Sie seine Kanäle A und B, oder kehren Sie ihn in den Einstellungen der Platine um</translation>
        </message>
        <message>
            <source>no motor moves anything: check the switch of the motor supply, the amplifiers' enable and the motor cables, and that nothing blocks the needle</source>
            <translation type="unfinished">kein Motor bewegt etwas: Prüfen Sie den Schalter der Motorversorgung, die Freigabe der Verstärker und die Motorkabel, und ob etwas die Nadel blockiert</translation>
        </message>
        <message>
            <source>the {motor} motor moves nothing up to 0.03 N·m: its joint is blocked, or its amplifier has no power or no enable</source>
            <translation type="unfinished">der Motor ({motor}) bewegt bis 0,03 N·m nichts: Sein Gelenk ist blockiert, oder sein Verstärker hat keinen Strom oder keine Freigabe</translation>
        </message>
        <message>
            <source>the motors are swapped: exchange the motor cables of left and right</source>
            <translation type="unfinished">die Motoren sind vertauscht: Tauschen Sie die Motorkabel links und rechts</translation>
        </message>
        <message>
            <source>both motors move the same encoder: the {other} encoder does not count, its joint is blocked, or both motors are wired to one amplifier</source>
            <translation type="unfinished">beide Motoren bewegen denselben Encoder: Der Encoder ({other}) zählt nicht, sein Gelenk ist blockiert, oder beide Motoren hängen an einem Verstärker</translation>
        </message>
        <message>
            <source>the {side} motor turns backwards: exchange its two leads, or reverse it in the board's settings</source>
            <translation type="unfinished">der Motor ({side}) dreht rückwärts: Tauschen Sie seine beiden Anschlüsse, oder kehren Sie ihn in den Einstellungen der Platine um</translation>
        </message>
        <message>
            <source>{title}: the left joint does not follow a step of {torque:g} N·m; run the sign check, and take the needle out</source>
            <translation type="unfinished">{title}: Das linke Gelenk folgt einem Sprung von {torque:g} N·m nicht; führen Sie die Vorzeichenkontrolle aus, und nehmen Sie die Nadel heraus</translation>
        </message>
        <message>
            <source>Latency: too few readings between rest and motion; is the link slow or the step lost?</source>
            <translation type="unfinished">Latenz: zu wenige Messwerte zwischen Ruhe und Bewegung; ist die Verbindung langsam oder ging der Sprung verloren?</translation>
        </message>
        <message>
            <source>Latency: the joint does not speed up under a constant torque</source>
            <translation type="unfinished">Latenz: Das Gelenk wird unter konstantem Drehmoment nicht schneller</translation>
        </message>
        <message>
            <source>device {device} has no calibration that could be undone</source>
            <translation type="unfinished">das Gerät {device} hat keine Kalibrierung, die sich rückgängig machen ließe</translation>
        </message>
        <message>
            <source>the board calls itself {key!r}; a serial number is up to 64 letters, digits, '.', '-' and '_': set another one in its firmware</source>
            <translation type="unfinished">die Platine nennt sich {key!r}; eine Seriennummer hat bis zu 64 Buchstaben, Ziffern, „.“, „-“ und „_“: Setzen Sie in ihrer Firmware eine andere</translation>
        </message>
        <message>
            <source>the calibration record is damaged: {error}; mend it, or move it away and calibrate anew (nothing was changed)</source>
            <translation type="unfinished">die Kalibrierdatei ist beschädigt: {error}; reparieren Sie sie, oder verschieben Sie sie und kalibrieren Sie neu (es wurde nichts geändert)</translation>
        </message>
        <message>
            <source>{path} belongs to device {record_device!r}, not {key!r}; it was copied or renamed</source>
            <translation type="unfinished">{path} gehört zum Gerät {record_device!r}, nicht zu {key!r}; die Datei wurde kopiert oder umbenannt</translation>
        </message>
        <message>
            <source>cannot write {path}: {error_strerror}; set ACUS_DATA to a folder that can be written</source>
            <translation type="unfinished">{path} lässt sich nicht schreiben: {error_strerror}; setzen Sie ACUS_DATA auf einen beschreibbaren Ordner</translation>
        </message>
        <message>
            <source>{report_failure} ({checks} counts no more: do this step again)</source>
            <translation type="unfinished">{report_failure} ({checks} gilt nicht mehr: Führen Sie diesen Schritt noch einmal aus)</translation>
        </message>
        <message>
            <source>encoder offsets left {left:+.5f} rad, right {right:+.5f} rad (by {reference})</source>
            <translation type="unfinished">Encoder-Nullpunkte links {left:+.5f} rad, rechts {right:+.5f} rad (Bezug: {reference})</translation>
        </message>
        <message>
            <source>by hand and by pulses</source>
            <translation type="unfinished">von Hand und mit Impulsen</translation>
        </message>
        <message>
            <source>by pulses only</source>
            <translation type="unfinished">nur mit Impulsen</translation>
        </message>
        <message>
            <source>motors and encoders agree, checked {how}</source>
            <translation type="unfinished">Motoren und Encoder stimmen überein, geprüft {how}</translation>
        </message>
        <message>
            <source>round trip {median:.2f} ms (99 %: {high:.2f}, largest {largest:.2f}), lost {lost:.2f} %, torque to motion {dead_time:.1f} ± {dead_time_spread:.1f} ms</source>
            <translation type="unfinished">Umlaufzeit {median:.2f} ms (99 %: {high:.2f}, größte {largest:.2f}), verloren {lost:.2f} %, vom Drehmoment zur Bewegung {dead_time:.1f} ± {dead_time_spread:.1f} ms</translation>
        </message>
        <message>
            <source>force scale {factor:.3f}, residual {residual:.3f} N: {verdict}</source>
            <translation type="unfinished">Kraftmaßstab {factor:.3f}, Restfehler {residual:.3f} N: {verdict}</translation>
        </message>
        <message>
            <source>gauge zero {zero:+.3f} N, scale {scale:.4f}, ± {residual:.3f} N</source>
            <translation type="unfinished">Kraftmesser: Nullpunkt {zero:+.3f} N, Skala {scale:.4f}, ± {residual:.3f} N</translation>
        </message>
        <message>
            <source>{title}: nothing is asked; there is nothing to answer</source>
            <translation type="unfinished">{title}: Es wird nichts gefragt; es gibt nichts zu beantworten</translation>
        </message>
        <message>
            <source>{title}: {reading} is not a number; type the reading in {report_unit}</source>
            <translation type="unfinished">{title}: {reading} ist keine Zahl; geben Sie den Messwert in {report_unit} ein</translation>
        </message>
        <message>
            <source>{title}: the joints do not stand still, or are not read; hold the needle still, or check the encoder cables</source>
            <translation type="unfinished">{title}: Die Gelenke stehen nicht still oder werden nicht gelesen; halten Sie die Nadel ruhig, oder prüfen Sie die Encoderkabel</translation>
        </message>
        <message>
            <source>{title}: {state_fault_message}</source>
            <translation type="unfinished">{title}: {state_fault_message}</translation>
        </message>
        <message>
            <source>the loop does not tick; start it before the routine</source>
            <translation type="unfinished">die Regelschleife läuft nicht; starten Sie sie vor dem Ablauf</translation>
        </message>
        <message>
            <source>the loop does not answer in time to arm the forces; close other programs, try again</source>
            <translation type="unfinished">die Regelschleife antwortet nicht rechtzeitig, um die Kräfte scharf zu schalten; schließen Sie andere Programme und versuchen Sie es noch einmal</translation>
        </message>
        <message>
            <source>the forces cannot be armed: {state_fault_message}</source>
            <translation type="unfinished">die Kräfte lassen sich nicht scharf schalten: {state_fault_message}</translation>
        </message>
        <message>
            <source>the loop has not answered within {patience:g} s: it does not tick</source>
            <translation type="unfinished">die Regelschleife hat seit {patience:g} s nicht geantwortet: Sie läuft nicht</translation>
        </message>
        <message>
            <source>the checkpoint's state has {state_size} slots, this program's {sv_slots}</source>
            <translation type="unfinished">der Zustand im Sicherungspunkt hat {state_size} Plätze, der dieses Programms {sv_slots}</translation>
        </message>
        <message>
            <source>this program's state has no slot {name!r}, which the record gives</source>
            <translation type="unfinished">der Zustand dieses Programms hat keinen Platz {name!r}, den die Aufzeichnung enthält</translation>
        </message>
        <message>
            <source>the record has no stage {stage_name!r} in this place; its stages are {checkpoint_names}</source>
            <translation type="unfinished">die Aufzeichnung hat an dieser Stelle keinen Schritt {stage_name!r}; ihre Schritte sind {checkpoint_names}</translation>
        </message>
        <message>
            <source>stage {stage_name!r} has {recorded_numbers} numbers in the record and {expected_numbers} in this program: another version recorded it</source>
            <translation type="unfinished">der Schritt {stage_name!r} hat in der Aufzeichnung {recorded_numbers} Zahlen und in diesem Programm {expected_numbers}: Sie stammt von einer anderen Version</translation>
        </message>
        <message>
            <source>{quantities} are {first} and {second}; both must be finite: calibrate anew</source>
            <translation type="unfinished">{quantities}: {first} und {second}; beide müssen endlich sein: Kalibrieren Sie neu</translation>
        </message>
        <message>
            <source>law {name!r}: {profile_name} cannot hold a direction by itself, its motors push; take the law 'fixture'</source>
            <translation type="unfinished">Kraftgesetz {name!r}: {profile_name} kann eine Richtung nicht von selbst halten, seine Motoren drücken; nehmen Sie das Kraftgesetz „fixture“</translation>
        </message>
        <message>
            <source>, or a device that can, such as {able}</source>
            <translation type="unfinished">, oder ein Gerät, das es kann, etwa {able}</translation>
        </message>
        <message>
            <source>{law_path}: parameters() gives an array of the shape {array_shape} for these values; give one of the shape (n,), and of {shortest} numbers at least, as it was tried</source>
            <translation type="unfinished">{law_path}: parameters() liefert für diese Werte ein Array der Form {array_shape}; liefern Sie eines der Form (n,), mit mindestens {shortest} Zahlen, denn so wurde es erprobt</translation>
        </message>
        <message>
            <source>{law_path}: energy_bound is {bound} J; give a finite number of 0 or more</source>
            <translation type="unfinished">{law_path}: energy_bound ist {bound} J; geben Sie eine endliche Zahl ab 0 an</translation>
        </message>
        <message>
            <source>{law_path}: step is not compiled; put @stage of core.compiled before it</source>
            <translation type="unfinished">{law_path}: step ist nicht kompiliert; setzen Sie @stage aus core.compiled davor</translation>
        </message>
        <message>
            <source>law 'forbidden_region': the region with its margin reaches {reach:.1f} mm from its axis, and the entry lies {distance:.1f} mm from it; move it or make it smaller</source>
            <translation type="unfinished">Kraftgesetz „forbidden_region“: Das Gebiet reicht mit seinem Abstand {reach:.1f} mm von seiner Achse weg, und der Einstichpunkt liegt {distance:.1f} mm von ihr; verschieben oder verkleinern Sie es</translation>
        </message>
        <message>
            <source>law 'forbidden_region': the region's axis points at the entry, so that a needle along it has no nearest point; turn the axis across the path or give a sphere</source>
            <translation type="unfinished">Kraftgesetz „forbidden_region“: Die Achse des Gebiets zeigt auf den Einstichpunkt, sodass eine Nadel entlang der Achse keinen nächsten Punkt hat; drehen Sie die Achse quer zum Pfad, oder geben Sie eine Kugel an</translation>
        </message>
        <message>
            <source>the loop did not stop in {stop_timeout:g} s: a stage does not return</source>
            <translation type="unfinished">die Regelschleife hielt nicht innerhalb von {stop_timeout:g} s an: Ein Schritt kehrt nicht zurück</translation>
        </message>
        <message>
            <source>the loop is closed; call open() before checkpoint()</source>
            <translation type="unfinished">die Regelschleife ist geschlossen; rufen Sie open() vor checkpoint() auf</translation>
        </message>
        <message>
            <source>step needs a loop on a VirtualClock; this one runs by itself</source>
            <translation type="unfinished">step braucht eine Regelschleife auf einer VirtualClock; diese läuft von selbst</translation>
        </message>
        <message>
            <source>the loop is closed; call open() before step()</source>
            <translation type="unfinished">die Regelschleife ist geschlossen; rufen Sie open() vor step() auf</translation>
        </message>
        <message>
            <source>the table can be swapped only while the loop is closed; close it first</source>
            <translation type="unfinished">die Tabelle lässt sich nur bei geschlossener Regelschleife austauschen; schließen Sie sie zuerst</translation>
        </message>
        <message>
            <source>the loop is closed; a table is exchanged while it runs, see swap()</source>
            <translation type="unfinished">die Regelschleife ist geschlossen; eine Tabelle wird im Lauf ausgetauscht, siehe swap()</translation>
        </message>
        <message>
            <source>the loop does not tick: the way it computes stays as it was</source>
            <translation type="unfinished">die Regelschleife läuft nicht: Die Art der Berechnung bleibt, wie sie war</translation>
        </message>
        <message>
            <source>the loop has ended: {reason}</source>
            <translation type="unfinished">die Regelschleife ist beendet: {reason}</translation>
        </message>
        <message>
            <source>the state has no slot {name!r}; valid names: {sv_index}</source>
            <translation type="unfinished">der Zustand hat keinen Platz {name!r}; gültige Namen: {sv_index}</translation>
        </message>
        <message>
            <source>the declared energy is {bound} J; give a finite number of 0 or more</source>
            <translation type="unfinished">die angegebene Energie ist {bound} J; geben Sie eine endliche Zahl ab 0 an</translation>
        </message>
        <message>
            <source>the loop has no input {name!r}; valid names: {input_names}</source>
            <translation type="unfinished">die Regelschleife hat keinen Eingang {name!r}; gültige Namen: {input_names}</translation>
        </message>
        <message>
            <source>device {profile_name}: its largest tension is {most} N and its fastest reel {profile_fastest_reel} m/s; give finite numbers of 0 or more</source>
            <translation type="unfinished">Gerät {profile_name}: Die größte Spannung ist {most} N und die schnellste Aufwicklung {profile_fastest_reel} m/s; geben Sie endliche Zahlen ab 0 an</translation>
        </message>
        <message>
            <source>law {law_name!r} needs the dynamics of the machine, and {device} states none</source>
            <translation type="unfinished">das Kraftgesetz {law_name!r} braucht die Dynamik der Maschine, und {device} gibt keine an</translation>
        </message>
        <message>
            <source>machine {profile_kind!r}: its stage is named {name!r}, and so is another of the loop; give it a name of its own</source>
            <translation type="unfinished">Maschine {profile_kind!r}: Ihr Schritt heißt {name!r}, und so heißt schon ein anderer der Regelschleife; geben Sie ihm einen eigenen Namen</translation>
        </message>
        <message>
            <source>{named} raises {fault}; mend or remove it, and start again</source>
            <translation type="unfinished">{named} meldet {fault}; beheben Sie den Fehler oder entfernen Sie die Ursache, und starten Sie neu</translation>
        </message>
        <message>
            <source>{named} does not return: there is no force any more; end the program, mend or remove it, and start again</source>
            <translation type="unfinished">{named} kehrt nicht zurück: Es gibt keine Kraft mehr; beenden Sie das Programm, beheben Sie den Fehler oder entfernen Sie die Ursache, und starten Sie neu</translation>
        </message>
        <message>
            <source>the force law or effect {name!r}</source>
            <translation type="unfinished">das Kraftgesetz oder der Effekt {name!r}</translation>
        </message>
        <message>
            <source>the stage {name!r} of the loop</source>
            <translation type="unfinished">der Schritt {name!r} der Regelschleife</translation>
        </message>
        <message>
            <source>the wire is good</source>
            <translation type="unfinished">die Leitung ist gut</translation>
        </message>
        <message>
            <source>{lost} of {commands} commands were never answered</source>
            <translation type="unfinished">Befehle ohne Antwort: {lost} von {commands}</translation>
        </message>
        <message>
            <source>the board fell silent {last_answer:.2f} s after the beginning: {unanswered}; check its power, its cable and its program, then test again</source>
            <translation type="unfinished">die Platine verstummte {last_answer:.2f} s nach dem Beginn: {unanswered}; prüfen Sie Stromversorgung, Kabel und Programm der Platine, und testen Sie noch einmal</translation>
        </message>
        <message>
            <source>{unanswered}, at most {most_lost} may be: check the cable and its plugs, and what else this computer has to do, then test again</source>
            <translation type="unfinished">{unanswered}, zulässig sind höchstens {most_lost}: Prüfen Sie Kabel und Stecker, und was dieser Computer sonst noch zu tun hat, und testen Sie noch einmal</translation>
        </message>
        <message>
            <source>only {count_nonzero} answers of the robot on {port} came within a tick of {rate_hz:g} ms; lower loop.rate_hz in the profile or use a faster port</source>
            <translation type="unfinished">Antworten des Roboters an {port}, die innerhalb eines Takts von {rate_hz:g} ms kamen: nur {count_nonzero}; senken Sie loop.rate_hz im Profil, oder nehmen Sie einen schnelleren Port</translation>
        </message>
        <message>
            <source>the robot on {port} was greeted, but answers no command; see its firmware</source>
            <translation type="unfinished">der Roboter an {port} hat sich gemeldet, beantwortet aber keinen Befehl; prüfen Sie seine Firmware</translation>
        </message>
        <message>
            <source>the board speaks version {theirs} of the protocol, this program version {wanted} ({received_bytes} bytes): update the {older_side} (docs/protocol.md)</source>
            <translation type="unfinished">die Platine spricht Version {theirs} des Protokolls, dieses Programm Version {wanted} ({received_bytes} Byte): Aktualisieren Sie die ältere Seite, {older_side} (docs/protocol.md)</translation>
        </message>
        <message>
            <source>no fault {name!r}; valid names: {faults}</source>
            <translation type="unfinished">es gibt keine Störung {name!r}; gültige Namen: {faults}</translation>
        </message>
        <message>
            <source>fault {name} is {setting:g}; it must be from 0 to {most:g}</source>
            <translation type="unfinished">Störung {name} ist {setting:g}; gültig ist 0 bis {most:g}</translation>
        </message>
        <message>
            <source>payload of {given_bytes} bytes; a frame holds 1 to {largest_payload}</source>
            <translation type="unfinished">Nutzdaten von {given_bytes} Byte; ein Rahmen fasst 1 bis {largest_payload}</translation>
        </message>
        <message>
            <source>device profile {profile_name} speaks the protocol haply but has no section haply; add it (see resources/devices/haply-2diy.yaml)</source>
            <translation type="unfinished">das Geräteprofil {profile_name} spricht das Protokoll haply, hat aber keinen Abschnitt haply; ergänzen Sie ihn (siehe resources/devices/haply-2diy.yaml)</translation>
        </message>
        <message>
            <source>the board reports error {code}, which this program does not know; see its firmware</source>
            <translation type="unfinished">die Platine meldet den Fehler {code}, den dieses Programm nicht kennt; siehe ihre Firmware</translation>
        </message>
        <message>
            <source>the link has not been opened yet; call open() first</source>
            <translation type="unfinished">die Verbindung wurde noch nicht geöffnet; rufen Sie zuerst open() auf</translation>
        </message>
        <message>
            <source>the pen's joint angles {angles} are not finite</source>
            <translation type="unfinished">die Gelenkwinkel {angles} des Stifts sind nicht endlich</translation>
        </message>
        <message>
            <source>serial ports cannot be used on this system: {error}</source>
            <translation type="unfinished">serielle Ports sind auf diesem System nicht verwendbar: {error}</translation>
        </message>
        <message>
            <source>there is no port {path}; serial ports here: {there}. Plug the robot in and look with `acus device list`</source>
            <translation type="unfinished">es gibt keinen Port {path}; serielle Ports hier: {there}. Schließen Sie den Roboter an und sehen Sie mit `acus device list` nach</translation>
        </message>
        <message>
            <source>you may not open {path}: add yourself to the group that owns it with `sudo usermod -aG dialout $USER`, then log out and in again</source>
            <translation type="unfinished">Sie dürfen {path} nicht öffnen: Nehmen Sie sich mit `sudo usermod -aG dialout $USER` in die Gruppe auf, der der Port gehört, und melden Sie sich ab und wieder an</translation>
        </message>
        <message>
            <source>{path} is busy: another program is using this robot; close it (`fuser -v {path}` names it)</source>
            <translation type="unfinished">{path} ist belegt: Ein anderes Programm benutzt diesen Roboter; schließen Sie es (`fuser -v {path}` nennt es)</translation>
        </message>
        <message>
            <source>{path} cannot be set to {baud} baud; correct wire.baud in the device profile</source>
            <translation type="unfinished">{path} lässt sich nicht auf {baud} Baud einstellen; korrigieren Sie wire.baud im Geräteprofil</translation>
        </message>
        <message>
            <source>{path} is not a serial port; see `acus device list`</source>
            <translation type="unfinished">{path} ist kein serieller Port; siehe `acus device list`</translation>
        </message>
        <message>
            <source>{path} has gone; plug the robot in again</source>
            <translation type="unfinished">{path} ist verschwunden; schließen Sie den Roboter wieder an</translation>
        </message>
        <message>
            <source>{path} cannot be used: {error}</source>
            <translation type="unfinished">{path} ist nicht verwendbar: {error}</translation>
        </message>
        <message>
            <source>no board that speaks Acus' protocol</source>
            <translation type="unfinished">keine Platine mit dem Protokoll von Acus</translation>
        </message>
        <message>
            <source>the board says that it belongs to a robot of the profile {info_profile!r}, the program was started for {wanted_name!r}; choose the profile {right_profile}</source>
            <translation type="unfinished">die Platine gibt an, zu einem Roboter mit dem Profil {info_profile!r} zu gehören, das Programm wurde für {wanted_name!r} gestartet; wählen Sie das Profil {right_profile}</translation>
        </message>
        <message>
            <source>the board counts {counts} per turn, the profile {wanted_name} says {encoder_counts_per_turn}; correct the profile or the firmware</source>
            <translation type="unfinished">die Platine zählt {counts} je Umdrehung, das Profil {wanted_name} sagt {encoder_counts_per_turn}; korrigieren Sie das Profil oder die Firmware</translation>
        </message>
        <message>
            <source>the board's watchdog waits {watchdog:g} ms, the profile {wanted_name} allows {wanted_wire_watchdog_ms:g} ms; update the firmware</source>
            <translation type="unfinished">die Überwachung der Platine wartet {watchdog:g} ms, das Profil {wanted_name} erlaubt {wanted_wire_watchdog_ms:g} ms; aktualisieren Sie die Firmware</translation>
        </message>
        <message>
            <source>no Haply board with number {board_number}</source>
            <translation type="unfinished">keine Haply-Platine mit der Nummer {board_number}</translation>
        </message>
        <message>
            <source>{whom} answers: {seen} bytes came, but they make no sense; check that this is the robot's port (acus device list), its profile, and the baud rate there (wire.baud)</source>
            <translation type="unfinished">{whom} antwortet: Es kamen {seen} Byte, aber sie ergeben keinen Sinn; prüfen Sie, ob dies der Port des Roboters ist (acus device list), dazu sein Profil und die Baudrate darin (wire.baud)</translation>
        </message>
        <message>
            <source>{whom} answers; check its power and cable, that this is the robot's port (acus device list), its profile, and the baud rate there (wire.baud)</source>
            <translation type="unfinished">{whom} antwortet; prüfen Sie Stromversorgung und Kabel, ob dies der Port des Roboters ist (acus device list), dazu sein Profil und die Baudrate darin (wire.baud)</translation>
        </message>
        <message>
            <source>nobody was greeted on {port} yet; call open() first</source>
            <translation type="unfinished">an {port} hat sich noch niemand gemeldet; rufen Sie zuerst open() auf</translation>
        </message>
        <message>
            <source>another robot answers on {port} (serial number {info_serial!r} instead of {serial!r}); plug the first one in again, or close and open the link</source>
            <translation type="unfinished">an {port} antwortet ein anderer Roboter (Seriennummer {info_serial!r} statt {serial!r}); schließen Sie den ersten wieder an, oder schließen und öffnen Sie die Verbindung</translation>
        </message>
        <message>
            <source>{port}: {error}</source>
            <translation type="unfinished">{port}: {error}</translation>
        </message>
        <message>
            <source>serial robots are driven from inside the compiled loop, which exists on Linux only; this is {sys_platform}: use the simulated robot here</source>
            <translation type="unfinished">serielle Roboter werden aus der kompilierten Regelschleife heraus angesteuert, die es nur unter Linux gibt; dies ist {sys_platform}: Verwenden Sie hier den simulierten Roboter</translation>
        </message>
        <message>
            <source>serial robots are driven on Linux only; this is {sys_platform}</source>
            <translation type="unfinished">serielle Roboter werden nur unter Linux angesteuert; dies ist {sys_platform}</translation>
        </message>
        <message>
            <source>no force: the encoders' directions were not seen; home against the stops (`--step homing`), or check the signs by hand (`--step signs` without --yes)</source>
            <translation type="unfinished">keine Kraft: Die Zählrichtungen der Encoder wurden nicht gesehen; referenzieren Sie an den Anschlägen (`--step homing`), oder prüfen Sie die Vorzeichen von Hand (`--step signs` ohne --yes)</translation>
        </message>
        <message>
            <source>forces are held to {cap:g} N: {lack}; weigh it with a kitchen scale (docs/hardware.md): `acus device calibrate PORT --step force`</source>
            <translation type="unfinished">die Kräfte bleiben auf {cap:g} N begrenzt: {lack}; messen Sie sie mit einer Küchenwaage nach (docs/hardware.md): `acus device calibrate PORT --step force`</translation>
        </message>
        <message>
            <source>the force scale of this device was never measured</source>
            <translation type="unfinished">der Kraftmaßstab dieses Geräts wurde nie gemessen</translation>
        </message>
        <message>
            <source>its force scale was measured with profile {profile}, not {profile_name}</source>
            <translation type="unfinished">sein Kraftmaßstab wurde mit dem Profil {profile} gemessen, nicht mit {profile_name}</translation>
        </message>
        <message>
            <source>its force scale was {force_factor:.2f} on {force_date}, outside 1 ± {scale_tolerance:g}</source>
            <translation type="unfinished">sein Kraftmaßstab war am {force_date} {force_factor:.2f}, außerhalb von 1 ± {scale_tolerance:g}</translation>
        </message>
        <message>
            <source>no force: the board does not number its power cycles, so it counts as not {lacks}; run `acus device calibrate PORT` after switching it on</source>
            <translation type="unfinished">keine Kraft: Die Platine zählt ihre Einschaltvorgänge nicht, daher gilt als nicht erledigt: {lacks}; führen Sie nach dem Einschalten `acus device calibrate PORT` aus</translation>
        </message>
        <message>
            <source>no force: the robot was not {lacks} since it was switched on; do that step in the menu Robot, Commissioning, or with `acus device calibrate PORT --step {step}`</source>
            <translation type="unfinished">keine Kraft: seit dem Einschalten des Roboters nicht erledigt: {lacks}; führen Sie diesen Schritt im Menü Roboter, Inbetriebnahme aus, oder mit `acus device calibrate PORT --step {step}`</translation>
        </message>
        <message>
            <source>the phantom needs no CT in the file: leave it out</source>
            <translation type="unfinished">das Phantom braucht kein CT in der Datei: Lassen Sie es weg</translation>
        </message>
        <message>
            <source>packing {name}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>cannot write {path}: {error_strerror}</source>
            <translation type="unfinished">{path} lässt sich nicht schreiben: {error_strerror}</translation>
        </message>
        <message>
            <source>{folder} holds {count} series; one is needed</source>
            <translation type="unfinished">Serien in {folder}: {count}; gebraucht wird genau eine</translation>
        </message>
        <message>
            <source>{subject} is another one than the exercise was made on: its digest is {digest}…, {wanted_digest}… is needed (acus ct digest tells it)</source>
            <translation type="unfinished">{subject} ist ein anderes als das, auf dem die Übung erstellt wurde: Seine Prüfsumme ist {digest}…, nötig ist {wanted_digest}… (acus ct digest nennt sie)</translation>
        </message>
        <message>
            <source>{path}: {exercise} is no text in UTF-8</source>
            <translation type="unfinished">{path}: {exercise} ist kein Text in UTF-8</translation>
        </message>
        <message>
            <source>cannot unpack {path}: {error_strerror}</source>
            <translation type="unfinished">{path} lässt sich nicht entpacken: {error_strerror}</translation>
        </message>
        <message>
            <source>{path} is no exercise file ({suffix}), or damaged: have it written again (acus exercise pack)</source>
            <translation type="unfinished">{path} ist keine Übungsdatei ({suffix}) oder beschädigt: Lassen Sie sie neu schreiben (acus exercise pack)</translation>
        </message>
        <message>
            <source>{path} holds {files} files; {most_files} are the most</source>
            <translation type="unfinished">Dateien in {path}: {files}; höchstens {most_files} sind erlaubt</translation>
        </message>
        <message>
            <source>{path} is not used: {member_filename!r} {reason}</source>
            <translation type="unfinished">{path} wird nicht verwendet: {member_filename!r}: {reason}</translation>
        </message>
        <message>
            <source>{path} is not used: {double_name!r} is in it twice</source>
            <translation type="unfinished">{path} wird nicht verwendet: {double_name!r} ist zweimal enthalten</translation>
        </message>
        <message>
            <source>{path} is no exercise file: it has no {manifest}</source>
            <translation type="unfinished">{path} ist keine Übungsdatei: {manifest} fehlt darin</translation>
        </message>
        <message>
            <source>{path}: {manifest} is not JSON</source>
            <translation type="unfinished">{path}: {manifest} ist kein JSON</translation>
        </message>
        <message>
            <source>{path} was written by a newer Acus ({declared}): its form is {version}, this program reads up to {format}: install the newer one</source>
            <translation type="unfinished">{path} wurde von einem neueren Acus ({declared}) geschrieben: Das Format ist {version}, dieses Programm liest bis {format}: Installieren Sie das neuere</translation>
        </message>
        <message>
            <source>{path} is not used: its list of files is not what it holds</source>
            <translation type="unfinished">{path} wird nicht verwendet: Die Dateiliste entspricht nicht dem Inhalt</translation>
        </message>
        <message>
            <source>{path} is not used: it would grow {growth:.0f} times to {unpacked_gb:.1f} GB</source>
            <translation type="unfinished">{path} wird nicht verwendet: Die Datei würde um das {growth:.0f}-Fache auf {unpacked_gb:.1f} GB wachsen</translation>
        </message>
        <message>
            <source>{path} unpacks to {whole:.1f} GB and {free:.1f} GB are free in the temporary folder: make room</source>
            <translation type="unfinished">{path} ist entpackt {whole:.1f} GB groß, und im temporären Ordner sind {free:.1f} GB frei: Schaffen Sie Platz</translation>
        </message>
        <message>
            <source>{path} is damaged at {name}: have it sent again</source>
            <translation type="unfinished">{path} ist bei {name} beschädigt: Lassen Sie die Datei noch einmal senden</translation>
        </message>
        <message>
            <source>unpacking {name}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{path}: {name} was altered after it was packed</source>
            <translation type="unfinished">{path}: {name} wurde nach dem Packen verändert</translation>
        </message>
        <message>
            <source>{path} is not used: exercise and {manifest} name different CTs</source>
            <translation type="unfinished">{path} wird nicht verwendet: Übung und {manifest} nennen verschiedene CTs</translation>
        </message>
        <message>
            <source>{path} does not hold its CT: name the folder of the one with the digest {wanted}… (--ct DIR; acus ct digest tells it)</source>
            <translation type="unfinished">{path} enthält sein CT nicht: Nennen Sie den Ordner dessen mit der Prüfsumme {wanted}… (--ct DIR; acus ct digest nennt sie)</translation>
        </message>
        <message>
            <source>none of the {series} CT series in {ct} is that of {path}: one with the digest {wanted}… is needed; name the folder that holds it</source>
            <translation type="unfinished">von den {series} CT-Serien in {ct} ist keine die von {path}: Gebraucht wird eine mit der Prüfsumme {wanted}…; nennen Sie den Ordner, der sie enthält</translation>
        </message>
        <message>
            <source>the library holds another CT under the name of this one, {taken_entry_name}: its digest is {again_digest}…, {wanted}… is needed; remove it first (acus library remove {taken_entry_name})</source>
            <translation type="unfinished">die Bibliothek enthält unter dem Namen {taken_entry_name} ein anderes CT: Seine Prüfsumme ist {again_digest}…, nötig ist {wanted}…; entfernen Sie es zuerst (acus library remove {taken_entry_name})</translation>
        </message>
        <message>
            <source>the exercise cannot be used here: {field}: {reason}</source>
            <translation type="unfinished">die Übung ist hier nicht verwendbar: {field}: {reason}</translation>
        </message>
        <message>
            <source>the id {exercise_id!r} is taken by a file that cannot be used, or by earlier versions: keep this exercise under another name (--as NAME)</source>
            <translation type="unfinished">die Kennung {exercise_id!r} ist durch eine unbrauchbare Datei oder durch frühere Versionen belegt: Bewahren Sie diese Übung unter einem anderen Namen auf (--as NAME)</translation>
        </message>
        <message>
            <source>there is another exercise {exercise_id!r}: keep this one under another name (--as NAME), or as a new version of it (--replace)</source>
            <translation type="unfinished">es gibt schon eine andere Übung {exercise_id!r}: Bewahren Sie diese unter einem anderen Namen auf (--as NAME), oder als neue Version davon (--replace)</translation>
        </message>
        <message>
            <source>the exercise names {name!r}, which the file does not hold</source>
            <translation type="unfinished">die Übung nennt {name!r}, das die Datei nicht enthält</translation>
        </message>
        <message>
            <source>there is no measurement to write: take one first</source>
            <translation type="unfinished">es gibt keine Messung zu schreiben: Messen Sie zuerst</translation>
        </message>
        <message>
            <source>{path_name}: measurements are written as .csv or .mrk.json</source>
            <translation type="unfinished">{path_name}: Messungen werden als .csv oder .mrk.json geschrieben</translation>
        </message>
        <message>
            <source>{path} is not JSON: {error_split}</source>
            <translation type="unfinished">{path} ist kein JSON: {error_split}</translation>
        </message>
        <message>
            <source>{origin}: {error}</source>
            <translation type="unfinished">{origin}: {error}</translation>
        </message>
        <message>
            <source>{origin}: {name} is {short}; needed: {wanted}</source>
            <translation type="unfinished">{origin}: {name} ist {short}; gebraucht wird: {wanted}</translation>
        </message>
        <message>
            <source>cannot read {path}: {reason}</source>
            <translation type="unfinished">{path} lässt sich nicht lesen: {reason}</translation>
        </message>
        <message>
            <source>{origin}: {reason}</source>
            <translation type="unfinished">{origin}: {reason}</translation>
        </message>
        <message>
            <source>{path}: panto_a1 {left} and panto_a5 {right} must lie on the x axis</source>
            <translation type="unfinished">{path}: panto_a1 {left} und panto_a5 {right} müssen auf der x-Achse liegen</translation>
        </message>
        <message>
            <source>has a document type declaration (DOCTYPE), which a URDF never needs</source>
            <translation type="unfinished">enthält eine Dokumenttyp-Deklaration (DOCTYPE), die ein URDF nie braucht</translation>
        </message>
        <message>
            <source>{path}: joint {name!r} is there twice</source>
            <translation type="unfinished">{path}: Das Gelenk {name!r} ist zweimal vorhanden</translation>
        </message>
        <message>
            <source>{path}: joint {name!r} is missing; there are: {there}</source>
            <translation type="unfinished">{path}: Das Gelenk {name!r} fehlt; vorhanden: {there}</translation>
        </message>
        <message>
            <source>{place}: rpy is {turned!r}; turned joints are not supported</source>
            <translation type="unfinished">{place}: rpy ist {turned!r}; gedrehte Gelenke werden nicht unterstützt</translation>
        </message>
        <message>
            <source>{path}: joint {name!r} stands at ({x}, {y}, {z}) m; a link of the arms goes along +x</source>
            <translation type="unfinished">{path}: Das Gelenk {name!r} steht bei ({x}, {y}, {z}) m; ein Glied der Arme verläuft entlang +x</translation>
        </message>
        <message>
            <source>{path}: the arms differ: {left} at {left_m} m, {right} at {right_m} m; Acus' pantograph is symmetric</source>
            <translation type="unfinished">{path}: Die Arme sind verschieden: {left} bei {left_m} m, {right} bei {right_m} m; der Pantograph von Acus ist symmetrisch</translation>
        </message>
        <message>
            <source>{path}: link 'tool_phi_link' has no cylinder, which is the needle</source>
            <translation type="unfinished">{path}: Das Glied „tool_phi_link“ hat keinen Zylinder, der die Nadel ist</translation>
        </message>
        <message>
            <source>{path}: link 'tool_phi_link' is missing; the needle is its cylinder</source>
            <translation type="unfinished">{path}: Das Glied „tool_phi_link“ fehlt; sein Zylinder ist die Nadel</translation>
        </message>
        <message>
            <source>{place}: {coordinates!r} is not three numbers</source>
            <translation type="unfinished">{place}: {coordinates!r} sind keine drei Zahlen</translation>
        </message>
        <message>
            <source>{place}: {expression!r} is a xacro expression; expand the file first (xacro FILE &gt; out.urdf)</source>
            <translation type="unfinished">{place}: {expression!r} ist ein xacro-Ausdruck; wandeln Sie die Datei zuerst um (xacro FILE &gt; out.urdf)</translation>
        </message>
        <message>
            <source>{place}: {coordinate!r} is not a number</source>
            <translation type="unfinished">{place}: {coordinate!r} ist keine Zahl</translation>
        </message>
        <message>
            <source>{place}: {coordinate!r} is not finite</source>
            <translation type="unfinished">{place}: {coordinate!r} ist nicht endlich</translation>
        </message>
        <message>
            <source>{path} {error}</source>
            <translation type="unfinished">{path} {error}</translation>
        </message>
        <message>
            <source>{path} is not XML: {error}</source>
            <translation type="unfinished">{path} ist kein XML: {error}</translation>
        </message>
        <message>
            <source>device {profile_name} does not reach all of its tilt limit of {profile_tilt_limit_deg:g}°: {error}</source>
            <translation type="unfinished">das Gerät {profile_name} erreicht seine Neigungsgrenze von {profile_tilt_limit_deg:g}° nicht überall: {error}</translation>
        </message>
        <message>
            <source>{effect}: {reason}; left out: {without}</source>
            <translation type="unfinished">{effect}: {reason}; weggelassen: {without}</translation>
        </message>
        <message>
            <source>{effect} is called for and absent: {reason}; add it, or say why not: without: {{{effect}: "…"}}</source>
            <translation type="unfinished">{effect} ist nötig und fehlt: {reason}; ergänzen Sie es, oder begründen Sie, warum nicht: without: {{{effect}: "…"}}</translation>
        </message>
        <message>
            <source>exercise {exercise_id}: without: {stranger} is not called for: nothing within reach needs it ({reasons}); take it out</source>
            <translation type="unfinished">Übung {exercise_id}: without: {stranger} ist nicht nötig: Nichts in Reichweite braucht es ({reasons}); nehmen Sie es heraus</translation>
        </message>
        <message>
            <source>{listed} hold the shaft</source>
            <translation type="unfinished">den Schaft halten fest: {listed}</translation>
        </message>
        <message>
            <source>{listed} rub along the shaft</source>
            <translation type="unfinished">am Schaft reiben: {listed}</translation>
        </message>
        <message>
            <source>the tip cuts its way: {listed}</source>
            <translation type="unfinished">die Spitze schneidet sich ihren Weg: {listed}</translation>
        </message>
        <message>
            <source>it is pierced: {listed}</source>
            <translation type="unfinished">durchstochen wird: {listed}</translation>
        </message>
        <message>
            <source>what is pierced gives way while the needle rests</source>
            <translation type="unfinished">was durchstochen wird, gibt nach, während die Nadel ruht</translation>
        </message>
        <message>
            <source>no needle goes through {listed}</source>
            <translation type="unfinished">keine Nadel geht hindurch: {listed}</translation>
        </message>
        <message>
            <source>along with the breath go {listed}</source>
            <translation type="unfinished">mit der Atmung bewegen sich: {listed}</translation>
        </message>
        <message>
            <source>a bevelled tip cuts a curved way</source>
            <translation type="unfinished">eine geschliffene Spitze schneidet einen gekrümmten Weg</translation>
        </message>
        <message>
            <source>the student chooses the entry: no layers lie along all paths</source>
            <translation type="unfinished">der Teilnehmer wählt den Einstichpunkt: Für alle möglichen Pfade lassen sich keine Gewebeschichten angeben</translation>
        </message>
        <message>
            <source>{first_names} and {more} more</source>
            <translation type="unfinished">{first_names} und {more} weitere</translation>
        </message>
        <message>
            <source>dials: a schedule needs at least one, such as [0.7, 0.4, 0]</source>
            <translation type="unfinished">dials: Ein Plan braucht mindestens einen Wert, etwa [0.7, 0.4, 0]</translation>
        </message>
        <message>
            <source>dials go with kind: schedule; performance follows the scores</source>
            <translation type="unfinished">dials gehört zu kind: schedule; performance folgt den Bewertungen</translation>
        </message>
        <message>
            <source>poor ({poor:g}) must not lie above good ({good:g})</source>
            <translation type="unfinished">poor ({poor:g}) darf nicht über good ({good:g}) liegen</translation>
        </message>
        <message>
            <source>probe_every: 1 would make every attempt a probe; give 0, or 2 and up</source>
            <translation type="unfinished">probe_every: 1 würde jeden Versuch zum Testversuch machen; geben Sie 0 an, oder 2 und mehr</translation>
        </message>
        <message>
            <source>no exercise {name_or_path!r}; there are {known_ids}, or give the path of a .yaml file</source>
            <translation type="unfinished">es gibt keine Übung {name_or_path!r}; vorhanden sind {known_ids}, oder geben Sie den Pfad einer .yaml-Datei an</translation>
        </message>
        <message>
            <source>there is no version {version} of the exercise {identifier!r}; there are: {there}</source>
            <translation type="unfinished">es gibt keine Version {version} der Übung {identifier!r}; vorhanden: {there}</translation>
        </message>
        <message>
            <source>{path}: {name}: {reason}</source>
            <translation type="unfinished">{path}: {name}: {reason}</translation>
        </message>
        <message>
            <source> (line {line})</source>
            <translation type="unfinished"> (Zeile {line})</translation>
        </message>
        <message>
            <source>{path}: {error}</source>
            <translation type="unfinished">{path}: {error}</translation>
        </message>
        <message>
            <source>{exercise_name!r} is not known; valid names are {names}, or the path of a .yaml file</source>
            <translation type="unfinished">{exercise_name!r} ist nicht bekannt; gültig sind {names}, oder der Pfad einer .yaml-Datei</translation>
        </message>
        <message>
            <source>give either phantom: {{seed: ...}} or folder: ..., one of the two</source>
            <translation type="unfinished">geben Sie entweder phantom: {{seed: ...}} oder folder: ... an, eines von beiden</translation>
        </message>
        <message>
            <source>folder holds a character that no path has</source>
            <translation type="unfinished">folder enthält ein Zeichen, das kein Pfad hat</translation>
        </message>
        <message>
            <source>series goes with folder; the phantom has one series only</source>
            <translation type="unfinished">series gehört zu folder; das Phantom hat nur eine Serie</translation>
        </message>
        <message>
            <source>digest goes with folder; the phantom is known by its seed</source>
            <translation type="unfinished">digest gehört zu folder; das Phantom ist durch seinen seed bestimmt</translation>
        </message>
        <message>
            <source>remedy goes with folder; the phantom is read as it is</source>
            <translation type="unfinished">remedy gehört zu folder; das Phantom wird gelesen, wie es ist</translation>
        </message>
        <message>
            <source>file names a file of structures</source>
            <translation type="unfinished">file nennt eine Datei mit Strukturen</translation>
        </message>
        <message>
            <source>rotation_deg must be within ±360°</source>
            <translation type="unfinished">rotation_deg muss innerhalb von ±360° liegen</translation>
        </message>
        <message>
            <source>no needle of {gauge} G; there are {known}</source>
            <translation type="unfinished">es gibt keine Nadel mit {gauge} G; vorhanden sind {known}</translation>
        </message>
        <message>
            <source>exercise {exercise_id} has no target to picture</source>
            <translation type="unfinished">die Übung {exercise_id} hat kein Ziel für ein Bild</translation>
        </message>
        <message>
            <source>there is no window {window!r}; there are: {presets}, or give {{width: …, level: …}} in HU</source>
            <translation type="unfinished">es gibt keine Fensterung {window!r}; vorhanden: {presets}, oder geben Sie {{width: …, level: …}} in HU an</translation>
        </message>
        <message>
            <source>locked keeps window, slab and layout: give at least one of them</source>
            <translation type="unfinished">locked hält window, slab und layout fest: Geben Sie mindestens eines davon an</translation>
        </message>
        <message>
            <source>exercise {exercise_id} has no plan of its own: the student places the entry in the window; nothing is chosen for him</source>
            <translation type="unfinished">die Übung {exercise_id} hat keinen eigenen Plan: Der Teilnehmer setzt den Einstichpunkt im Fenster; nichts wird für ihn gewählt</translation>
        </message>
        <message>
            <source>exercise {exercise_id}: nothing declares the view {view_name!r}; declared are {views}; see 'How to add a view'</source>
            <translation type="unfinished">Übung {exercise_id}: Nichts deklariert die Ansicht {view_name!r}; deklariert sind {views}; siehe „How to add a view“</translation>
        </message>
        <message>
            <source>a list of {info_field_name} holds names only</source>
            <translation type="unfinished">eine Liste unter {info_field_name} enthält nur Namen</translation>
        </message>
        <message>
            <source>one of the {info_field_name} is named twice</source>
            <translation type="unfinished">unter {info_field_name} ist ein Name zweimal genannt</translation>
        </message>
        <message>
            <source>no effect is called {name!r}; there are {names}</source>
            <translation type="unfinished">kein Effekt heißt {name!r}; vorhanden sind {names}</translation>
        </message>
        <message>
            <source>{name} is left out without a reason: say why</source>
            <translation type="unfinished">{name} ist ohne Begründung weggelassen: Geben Sie den Grund an</translation>
        </message>
        <message>
            <source>without: {effect_name} is left out, and the exercise asks for it: one of the two</source>
            <translation type="unfinished">without: {effect_name} ist weggelassen, und die Übung verlangt es: nur eines von beiden</translation>
        </message>
        <message>
            <source>at least one metric needs a weight above 0</source>
            <translation type="unfinished">mindestens eine Messgröße braucht ein Gewicht über 0</translation>
        </message>
        <message>
            <source>structures: {structure_name!r} is a risk twice</source>
            <translation type="unfinished">structures: {structure_name!r} ist zweimal als Risiko genannt</translation>
        </message>
        <message>
            <source>locks: an assessment locks all controls, and {free} is missing: leave locks out, or use purpose: practice</source>
            <translation type="unfinished">locks: Eine Prüfung sperrt alle Bedienelemente, und {free} fehlt: Lassen Sie locks weg, oder nehmen Sie purpose: practice</translation>
        </message>
        <message>
            <source>fading: an assessment is the same for everybody: leave fading out, or use purpose: practice</source>
            <translation type="unfinished">fading: Eine Prüfung ist für alle gleich: Lassen Sie fading weg, oder nehmen Sie purpose: practice</translation>
        </message>
        <message>
            <source>plan {{own: true}} of a CT folder needs target_mm: [x, y, z]</source>
            <translation type="unfinished">plan {{own: true}} bei einem CT-Ordner braucht target_mm: [x, y, z]</translation>
        </message>
        <message>
            <source>plan phantom_default needs ct: {{phantom: ...}}; give entry_mm and target_mm</source>
            <translation type="unfinished">plan phantom_default braucht ct: {{phantom: ...}}; geben Sie entry_mm und target_mm an</translation>
        </message>
        <message>
            <source>touch: the targets lie about a path that the file names: give plan entry_mm and target_mm</source>
            <translation type="unfinished">touch: Die Ziele liegen um einen Pfad, den die Datei nennt: Geben Sie unter plan entry_mm und target_mm an</translation>
        </message>
        <message>
            <source>touch: the targets are touched by sight: use guidance.mode: live</source>
            <translation type="unfinished">touch: Die Ziele werden nach Sicht berührt: Nehmen Sie guidance.mode: live</translation>
        </message>
        <message>
            <source>depth_mm: {near:g} to {far:g} mm; give the smaller one first</source>
            <translation type="unfinished">depth_mm: {near:g} bis {far:g} mm; nennen Sie den kleineren Wert zuerst</translation>
        </message>
        <message>
            <source>give either targets_mm: [[x, y, z], …] or pattern: {{…}}, one of both</source>
            <translation type="unfinished">geben Sie entweder targets_mm: [[x, y, z], …] oder pattern: {{…}} an, eines von beiden</translation>
        </message>
        <message>
            <source>touch.pattern: {targets} targets that follow each other {apart:g} radii of {radius_mm:g} mm apart find no room within {pattern_within_deg:g}° and depths of {least_depth_mm:g} to {largest_depth_mm:g} mm; give more room or a smaller radius</source>
            <translation type="unfinished">touch.pattern: Ziele: {targets}; aufeinanderfolgende, die {apart:g} Radien von {radius_mm:g} mm voneinander entfernt sind, finden innerhalb von {pattern_within_deg:g}° und in Tiefen von {least_depth_mm:g} bis {largest_depth_mm:g} mm keinen Platz; geben Sie mehr Platz oder einen kleineren Radius</translation>
        </message>
        <message>
            <source>touch: target {target_number}: {error}</source>
            <translation type="unfinished">touch: Ziel {target_number}: {error}</translation>
        </message>
        <message>
            <source>it lies {depth_mm:.1f} mm from the trocar, not {least_mm:g} mm</source>
            <translation type="unfinished">sie liegt {depth_mm:.1f} mm vom Trokar, nicht {least_mm:g} mm</translation>
        </message>
        <message>
            <source>it lies {depth_mm:.1f} mm from the trocar, within its own radius of {radius_mm:g} mm, where a tool that only comes in touches it</source>
            <translation type="unfinished">sie liegt {depth_mm:.1f} mm vom Trokar, innerhalb des Zielradius von {radius_mm:g} mm, wo ein Instrument sie schon beim Hereinkommen berührt</translation>
        </message>
        <message>
            <source>touch: target {target_number} at [{x:g}, {y:g}, {z:g}] mm cannot be touched with {profile_name}: {reasons}. Reachable are targets {least_depth:g} to {limits_depth_limit_mm:.0f} mm from the entry, by a way that leans at most {limits_tilt_limit_deg:.0f}° from straight down</source>
            <translation type="unfinished">touch: Ziel {target_number} bei [{x:g}, {y:g}, {z:g}] mm ist mit {profile_name} nicht zu berühren: {reasons}. Erreichbar sind Ziele {least_depth:g} bis {limits_depth_limit_mm:.0f} mm vom Einstichpunkt, auf einem Weg, der höchstens {limits_tilt_limit_deg:.0f}° von der Senkrechten abweicht</translation>
        </message>
        <message>
            <source>touch: targets {first} and {second} lie {gap:.1f} mm apart; with a radius of {radius_mm:g} mm a tip that stays touches both: lay them more than {least_gap_mm:g} mm apart, or give a smaller radius_mm</source>
            <translation type="unfinished">touch: Die Ziele {first} und {second} liegen {gap:.1f} mm auseinander; bei einem Radius von {radius_mm:g} mm berührt eine ruhende Spitze beide: Legen Sie sie mehr als {least_gap_mm:g} mm auseinander, oder geben Sie ein kleineres radius_mm an</translation>
        </message>
        <message>
            <source>exercise {exercise_id} would be a file of {size_kb} kB; {largest_file} kB are the most: shorten its texts</source>
            <translation type="unfinished">die Übung {exercise_id} ergäbe eine Datei von {size_kb} kB; höchstens {largest_file} kB sind erlaubt: Kürzen Sie ihre Texte</translation>
        </message>
        <message>
            <source>exercise {exercise_id} cannot be written as YAML: it reads back otherwise</source>
            <translation type="unfinished">die Übung {exercise_id} lässt sich nicht als YAML schreiben: Wieder gelesen ist sie anders</translation>
        </message>
        <message>
            <source>id: {exercise_id!r} is an exercise that comes with Acus and stays as it is: save yours under another id (duplicate it)</source>
            <translation type="unfinished">id: {exercise_id!r} ist eine mitgelieferte Übung und bleibt, wie sie ist: Speichern Sie Ihre unter einer anderen Kennung (duplizieren Sie sie)</translation>
        </message>
        <message>
            <source>{path} is there and cannot be used: repair it (acus exercise validate {path}) or move it away, then save again</source>
            <translation type="unfinished">{path} ist vorhanden und nicht verwendbar: Reparieren Sie die Datei (acus exercise validate {path}), oder verschieben Sie sie, und speichern Sie dann noch einmal</translation>
        </message>
        <message>
            <source>cannot write in {folder}: {error_strerror}; ACUS_DATA moves it</source>
            <translation type="unfinished">in {folder} lässt sich nicht schreiben: {error_strerror}; ACUS_DATA legt einen anderen Ordner fest</translation>
        </message>
        <message>
            <source>its slices differ in {names}: neighbours may not compare</source>
            <translation type="unfinished">die Schichten unterscheiden sich in {names}: Benachbarte sind womöglich nicht vergleichbar</translation>
        </message>
        <message>
            <source>{doubled} different images share a SOPInstanceUID</source>
            <translation type="unfinished">verschiedene Bilder mit gleicher SOPInstanceUID: {doubled}</translation>
        </message>
        <message>
            <source>1 file is a copy and left out</source>
            <translation type="unfinished">1 Datei ist eine Kopie und wird weggelassen</translation>
        </message>
        <message>
            <source>{count} files are copies and left out</source>
            <translation type="unfinished">{count} Dateien sind Kopien und werden weggelassen</translation>
        </message>
        <message>
            <source>there is no body in this CT, so there is no skin</source>
            <translation type="unfinished">in diesem CT gibt es keinen Körper und daher keine Haut</translation>
        </message>
        <message>
            <source>looking for the body</source>
            <translation type="unfinished">Körper wird gesucht</translation>
        </message>
        <message>
            <source>taking the table away</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>filling the lungs</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>body found</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>the line starts in the body, {depth:.1f} mm from the skin</source>
            <translation type="unfinished">die Linie beginnt im Körper, {depth:.1f} mm von der Haut</translation>
        </message>
        <message>
            <source>the line never meets the body; its end is {distance:.1f} mm from the skin</source>
            <translation type="unfinished">die Linie trifft den Körper nie; ihr Ende ist {distance:.1f} mm von der Haut entfernt</translation>
        </message>
        <message>
            <source>the entry lies {distance:.1f} mm {where}; click within {tolerance_mm:g} mm of the skin</source>
            <translation type="unfinished">der Einstichpunkt liegt {distance:.1f} mm von der Haut ({where}); klicken Sie höchstens {tolerance_mm:g} mm neben die Haut</translation>
        </message>
        <message>
            <source>its pixels cannot be decoded ({fault})</source>
            <translation type="unfinished">die Pixel lassen sich nicht dekodieren ({fault})</translation>
        </message>
        <message>
            <source>decodes to {size} pixels where {out_size} are needed</source>
            <translation type="unfinished">ergibt dekodiert {size} Pixel, nötig sind {out_size}</translation>
        </message>
        <message>
            <source>a decoder for transfer syntax {syntax} is missing: pip install {package}</source>
            <translation type="unfinished">ein Decoder für die Transfersyntax {syntax} fehlt: pip install {package}</translation>
        </message>
        <message>
            <source>its pixels are compressed as {found_compression}, and its transfer syntax is of {stated_compression}; have it sent again</source>
            <translation type="unfinished">die Pixel sind als {found_compression} komprimiert, und die Transfersyntax gilt für {stated_compression}; lassen Sie die Datei noch einmal senden</translation>
        </message>
        <message>
            <source>its compressed pixels are damaged (no frame header)</source>
            <translation type="unfinished">die komprimierten Pixel sind beschädigt (kein Frame-Header)</translation>
        </message>
        <message>
            <source>its compressed picture is {columns} × {rows}, its header says {form_columns} × {form_rows}</source>
            <translation type="unfinished">das komprimierte Bild hat {columns} × {rows}, die Kopfdaten sagen {form_columns} × {form_rows}</translation>
        </message>
        <message>
            <source>{samples} samples per compressed pixel, its header says {form_samples}</source>
            <translation type="unfinished">Werte je komprimiertem Pixel: {samples}, die Kopfdaten sagen {form_samples}</translation>
        </message>
        <message>
            <source>{precision} bits per compressed pixel do not fit BitsAllocated {form_bits_allocated}</source>
            <translation type="unfinished">Bits je komprimiertem Pixel: {precision}, das passt nicht zu BitsAllocated {form_bits_allocated}</translation>
        </message>
        <message>
            <source>its compressed pixels are damaged (no RLE header)</source>
            <translation type="unfinished">die komprimierten Pixel sind beschädigt (kein RLE-Header)</translation>
        </message>
        <message>
            <source>{segments} RLE segments where {wanted} are needed</source>
            <translation type="unfinished">RLE-Segmente: {segments}, nötig sind {wanted}</translation>
        </message>
        <message>
            <source>{header_path} cannot be read: {error_strerror}</source>
            <translation type="unfinished">{header_path} lässt sich nicht lesen: {error_strerror}</translation>
        </message>
        <message>
            <source>{header_path} has changed since the folder was searched; search it again</source>
            <translation type="unfinished">{header_path} hat sich geändert, seit der Ordner durchsucht wurde; durchsuchen Sie ihn noch einmal</translation>
        </message>
        <message>
            <source>{header_path}: {header_pixels_damage}</source>
            <translation type="unfinished">{header_path}: {header_pixels_damage}</translation>
        </message>
        <message>
            <source>{header_path} ends {missing_bytes} bytes too early; read it again</source>
            <translation type="unfinished">{header_path} endet um {missing_bytes} Byte zu früh; lesen Sie die Datei noch einmal ein</translation>
        </message>
        <message>
            <source>{header_path}: {error}</source>
            <translation type="unfinished">{header_path}: {error}</translation>
        </message>
        <message>
            <source>{header_path} inflates to {needed} bytes too few</source>
            <translation type="unfinished">{header_path} ergibt entpackt {needed} Byte zu wenig</translation>
        </message>
        <message>
            <source>{header_path} cannot be decoded ({brief})</source>
            <translation type="unfinished">{header_path} lässt sich nicht dekodieren ({brief})</translation>
        </message>
        <message>
            <source>its data set is not deflated as its transfer syntax says, or damaged ({error})</source>
            <translation type="unfinished">der Datensatz ist nicht so komprimiert (deflate), wie die Transfersyntax sagt, oder beschädigt ({error})</translation>
        </message>
        <message>
            <source>its header cannot be read ({brief})</source>
            <translation type="unfinished">die Kopfdaten lassen sich nicht lesen ({brief})</translation>
        </message>
        <message>
            <source>its transfer syntax says {stated_order} endian, and its header is {found_order} endian; have it sent again</source>
            <translation type="unfinished">die Transfersyntax sagt {stated_order} endian, und die Kopfdaten sind {found_order} endian; lassen Sie die Datei noch einmal senden</translation>
        </message>
        <message>
            <source>{name} is {quantity:g}{unit}; its size must lie between {least:g} and {most:g}{unit}</source>
            <translation type="unfinished">{name} ist {quantity:g}{unit}; der Betrag muss zwischen {least:g} und {most:g}{unit} liegen</translation>
        </message>
        <message>
            <source>{name} does not hold finite numbers{wanted}{quoted}</source>
            <translation type="unfinished">{name} enthält keine endlichen Zahlen{wanted}{quoted}</translation>
        </message>
        <message>
            <source>{name} has {byte_length} bytes; 2 are needed</source>
            <translation type="unfinished">{name} hat {byte_length} Byte; nötig sind 2</translation>
        </message>
        <message>
            <source>{name} is not an integer</source>
            <translation type="unfinished">{name} ist keine ganze Zahl</translation>
        </message>
        <message>
            <source>ImageOrientationPatient {orientation} is not two perpendicular unit vectors</source>
            <translation type="unfinished">ImageOrientationPatient {orientation} sind keine zwei zueinander senkrechten Einheitsvektoren</translation>
        </message>
        <message>
            <source>{keyword} of a frame is not {count} finite numbers</source>
            <translation type="unfinished">{keyword} eines Frames: nötig sind endliche Zahlen, Anzahl {count}</translation>
        </message>
        <message>
            <source>NumberOfFrames is {stated_frames}, and {described_frames} frames are described</source>
            <translation type="unfinished">NumberOfFrames ist {stated_frames}, beschrieben sind {described_frames} Frames</translation>
        </message>
        <message>
            <source>PixelSpacing is {spacing}; both must be above zero</source>
            <translation type="unfinished">PixelSpacing ist {spacing}; beide Werte müssen über null liegen</translation>
        </message>
        <message>
            <source>RescaleSlope is 0; every pixel would have the same value</source>
            <translation type="unfinished">RescaleSlope ist 0; jedes Pixel hätte denselben Wert</translation>
        </message>
        <message>
            <source>the values of this volume are in {volume_unit}, not in HU: tissue is told by Hounsfield values; give the layers by hand</source>
            <translation type="unfinished">die Werte dieses Volumens sind in {volume_unit}, nicht in HU: Gewebe wird an Hounsfield-Werten erkannt; geben Sie die Gewebeschichten von Hand an</translation>
        </message>
        <message>
            <source>there is no body in this CT: all of it is air</source>
            <translation type="unfinished">in diesem CT gibt es keinen Körper: Alles ist Luft</translation>
        </message>
        <message>
            <source>reading the CT on the field's grid</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>looking for the skin</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>looking for lung and gut</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>looking for bone</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>parting fat, muscle and organs</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>laying structures over it</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>placing the boundaries</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>the tissue field is made</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>no bone was found: no needle can be told that it met one</source>
            <translation type="unfinished">es wurde kein Knochen gefunden: Ob die Nadel auf einen trifft, lässt sich nicht sagen</translation>
        </message>
        <message>
            <source>no lung was found within reach</source>
            <translation type="unfinished">in Reichweite wurde keine Lunge gefunden</translation>
        </message>
        <message>
            <source>bright tissue without cortex may be bone or contrast: mark it to be sure</source>
            <translation type="unfinished">helles Gewebe ohne Kortikalis kann Knochen oder Kontrastmittel sein: Markieren Sie es, um sicherzugehen</translation>
        </message>
        <message>
            <source>labelling the built-in patient</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>a field of {spacing_mm:g} mm: {named} mm can be chosen</source>
            <translation type="unfinished">ein Feld von {spacing_mm:g} mm: wählbar sind {named} mm</translation>
        </message>
        <message>
            <source>a reach of {reach_mm:g} mm: more than 0 and less than 2000 mm are</source>
            <translation type="unfinished">eine Reichweite von {reach_mm:g} mm: möglich sind mehr als 0 und weniger als 2000 mm</translation>
        </message>
        <message>
            <source>entry {entry_mm} mm lies outside the CT: move it</source>
            <translation type="unfinished">der Einstichpunkt {entry_mm} mm liegt außerhalb des CT: Verschieben Sie ihn</translation>
        </message>
        <message>
            <source>the CT ends {to_end_mm:.0f} mm from the entry, within the body, and the needle reaches {reach_mm:.0f} mm: what lies beyond is unknown</source>
            <translation type="unfinished">das CT endet {to_end_mm:.0f} mm vom Einstichpunkt, noch im Körper, und die Nadel reicht {reach_mm:.0f} mm weit: Was dahinter liegt, ist unbekannt</translation>
        </message>
        <message>
            <source>the CT is {thickness_mm:.1f} mm thick: no field of {spacing_mm:g} mm fits</source>
            <translation type="unfinished">das CT ist {thickness_mm:.1f} mm dick: Ein Feld von {spacing_mm:g} mm passt nicht hinein</translation>
        </message>
        <message>
            <source>looking for the tissue field in the cache</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>the tissue field was there</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>a tissue field of {grid_spacing_mm:g} mm takes {megabytes:.0f} MB here; {most_mb:g} are allowed: {advice}</source>
            <translation type="unfinished">ein Gewebefeld von {grid_spacing_mm:g} mm braucht hier {megabytes:.0f} MB; erlaubt sind {most_mb:g}: {advice}</translation>
        </message>
        <message>
            <source>making a tissue field of {grid_spacing_mm:g} mm takes {grid_voxels:.1f} GB of memory, and {free:.1f} GB are free: {advice}</source>
            <translation type="unfinished">ein Gewebefeld von {grid_spacing_mm:g} mm zu berechnen braucht {grid_voxels:.1f} GB Speicher, und {free:.1f} GB sind frei: {advice}</translation>
        </message>
        <message>
            <source>structure {tissue_words} lies beyond the reach</source>
            <translation type="unfinished">die Struktur {tissue_words} liegt außer Reichweite</translation>
        </message>
        <message>
            <source>{structures} structures: a field has room for {most_structures}</source>
            <translation type="unfinished">Strukturen: {structures}; ein Feld hat Platz für {most_structures}</translation>
        </message>
        <message>
            <source>structures {over} and {under} overlap by {millilitres:.2g} ml, which count as {over}</source>
            <translation type="unfinished">die Strukturen {over} und {under} überlappen sich um {millilitres:.2g} ml, die als {over} zählen</translation>
        </message>
        <message>
            <source>this is no tissue field: it does not begin as one</source>
            <translation type="unfinished">dies ist kein Gewebefeld: Der Anfang ist nicht der eines solchen</translation>
        </message>
        <message>
            <source>the tissue field is damaged ({error_name})</source>
            <translation type="unfinished">das Gewebefeld ist beschädigt ({error_name})</translation>
        </message>
        <message>
            <source>a tissue field of {shape} voxels is none that can be read</source>
            <translation type="unfinished">ein Gewebefeld von {shape} Voxeln lässt sich nicht lesen</translation>
        </message>
        <message>
            <source>the tissue field is damaged: a part of it is not what was written</source>
            <translation type="unfinished">das Gewebefeld ist beschädigt: Ein Teil davon ist nicht, was geschrieben wurde</translation>
        </message>
        <message>
            <source>the tissue field is another than its digest says</source>
            <translation type="unfinished">das Gewebefeld ist ein anderes, als seine Prüfsumme sagt</translation>
        </message>
        <message>
            <source>the tissue field holds more than its {most} voxels</source>
            <translation type="unfinished">das Gewebefeld enthält mehr als seine {most} Voxel</translation>
        </message>
        <message>
            <source>labels of {labels_shape}, distances of {distance_shape} voxels: both need one shape (nz, ny, nx) of two voxels at least</source>
            <translation type="unfinished">Labels mit {labels_shape}, Abstände mit {distance_shape} Voxeln: Beide brauchen dieselbe Form (nz, ny, nx) mit mindestens zwei Voxeln</translation>
        </message>
        <message>
            <source>labels are {labels_dtype} and distances {distance_dtype}; uint8 and int8 are needed</source>
            <translation type="unfinished">die Labels sind {labels_dtype} und die Abstände {distance_dtype}; nötig sind uint8 und int8</translation>
        </message>
        <message>
            <source>the table of tissues has the codes {codes}; row = code is needed</source>
            <translation type="unfinished">die Gewebetabelle hat die Codes {codes}; nötig ist Zeile = Code</translation>
        </message>
        <message>
            <source>code 0 is {tissues_first_words}; it must be unknown</source>
            <translation type="unfinished">Code 0 ist {tissues_first_words}; er muss unbekannt sein</translation>
        </message>
        <message>
            <source>label {largest} has no row in the table of {tissues} tissues</source>
            <translation type="unfinished">das Label {largest} hat keine Zeile in der Gewebetabelle (Gewebe: {tissues})</translation>
        </message>
        <message>
            <source>a distance is negative; they have no sign</source>
            <translation type="unfinished">ein Abstand ist negativ; Abstände haben kein Vorzeichen</translation>
        </message>
        <message>
            <source>affine_mm {affine} is singular</source>
            <translation type="unfinished">affine_mm {affine} ist singulär</translation>
        </message>
        <message>
            <source>the volume needs {size:.1f} GB of memory, which this machine cannot give</source>
            <translation type="unfinished">das Volumen braucht {size:.1f} GB Speicher, die dieser Computer nicht hergibt</translation>
        </message>
        <message>
            <source>slice {ready} of {count}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>pydicom is loaded</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{absent} {verb} missing, without which its pixels cannot be told</source>
            <translation type="unfinished">{absent} {verb} nicht vorhanden; ohne diese Angaben lassen sich die Pixel nicht deuten</translation>
        </message>
        <message>
            <source>PixelRepresentation is {representation}; it must be 0 or 1</source>
            <translation type="unfinished">PixelRepresentation ist {representation}; gültig ist 0 oder 1</translation>
        </message>
        <message>
            <source>the library {library} cannot be written: {reason}</source>
            <translation type="unfinished">in die Bibliothek {library} lässt sich nicht schreiben: {reason}</translation>
        </message>
        <message>
            <source>{reason}; nothing was kept</source>
            <translation type="unfinished">{reason}; es wurde nichts aufbewahrt</translation>
        </message>
        <message>
            <source>a file of the series is gone: the folder was moved or its medium taken out; nothing was kept</source>
            <translation type="unfinished">eine Datei der Serie fehlt jetzt: Der Ordner wurde verschoben oder der Datenträger entfernt; es wurde nichts aufbewahrt</translation>
        </message>
        <message>
            <source>the disk of the library has {free:.0f} MB free, this series needs {needed:.0f} MB; make room, nothing was kept</source>
            <translation type="unfinished">auf dem Datenträger der Bibliothek sind {free:.0f} MB frei, diese Serie braucht {needed:.0f} MB; schaffen Sie Platz, es wurde nichts aufbewahrt</translation>
        </message>
        <message>
            <source>the disk of the library is full</source>
            <translation type="unfinished">der Datenträger der Bibliothek ist voll</translation>
        </message>
        <message>
            <source>all {stored_images} images of this series are in the library already; the {given_images} given are a part of them</source>
            <translation type="unfinished">alle Bilder dieser Serie ({stored_images}) sind schon in der Bibliothek; die übergebenen ({given_images}) sind ein Teil davon</translation>
        </message>
        <message>
            <source>was in the library already, image for image</source>
            <translation type="unfinished">war schon in der Bibliothek, Bild für Bild</translation>
        </message>
        <message>
            <source>taken into the library, in place of {earlier_images} of its {new_images} images that lay there</source>
            <translation type="unfinished">in die Bibliothek aufgenommen ({new_images} Bilder), anstelle der bisherigen {earlier_images}</translation>
        </message>
        <message>
            <source>taken into the library</source>
            <translation type="unfinished">in die Bibliothek aufgenommen</translation>
        </message>
        <message>
            <source>no CT {name!r} in the library; it holds {valid}</source>
            <translation type="unfinished">es gibt kein CT {name!r} in der Bibliothek; sie enthält {valid}</translation>
        </message>
        <message>
            <source>{files} files taken into the library</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>this series is not taken into the library: {name} differs among its files, and they would get one pseudonym; give the files of one patient's study alone</source>
            <translation type="unfinished">diese Serie wird nicht in die Bibliothek aufgenommen: {name} ist in ihren Dateien verschieden, und alle bekämen ein und dasselbe Pseudonym; übergeben Sie nur die Dateien der Studie eines Patienten</translation>
        </message>
        <message>
            <source>{series_reason}; {reason}</source>
            <translation type="unfinished">{series_reason}; {reason}</translation>
        </message>
        <message>
            <source>this series cannot be used: {series_reason}{offer}</source>
            <translation type="unfinished">diese Serie ist nicht verwendbar: {series_reason}{offer}</translation>
        </message>
        <message>
            <source>the library holds {stored_images} images of this series as {name}; of the {given_images} given {known_images} are among them and {images_not_given} of those there are not given: give all images of the series at once, or remove what lies there first (acus library remove {name}); nothing was changed</source>
            <translation type="unfinished">die Bibliothek enthält von dieser Serie {stored_images} Bilder als {name}; von den {given_images} übergebenen gehören {known_images} dazu, und {images_not_given} der dortigen wurden nicht übergeben: Übergeben Sie alle Bilder der Serie auf einmal, oder entfernen Sie zuerst, was dort liegt (acus library remove {name}); es wurde nichts geändert</translation>
        </message>
        <message>
            <source>{error}; nothing was kept</source>
            <translation type="unfinished">{error}; es wurde nichts aufbewahrt</translation>
        </message>
        <message>
            <source>checking what was written</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source> beside the {open:.1f} GB of what is open</source>
            <translation type="unfinished"> neben den {open:.1f} GB dessen, was offen ist</translation>
        </message>
        <message>
            <source>needs {bytes:.1f} GB of memory, and {available:.1f} GB are free{beside}; fits with {i} × {j} × {k} voxels taken together</source>
            <translation type="unfinished">braucht {bytes:.1f} GB Speicher, und {available:.1f} GB sind frei{beside}; passt, wenn {i} × {j} × {k} Voxel zusammengefasst werden</translation>
        </message>
        <message>
            <source>series {series_key} cannot be used: {series_reason}</source>
            <translation type="unfinished">die Serie {series_key} ist nicht verwendbar: {series_reason}</translation>
        </message>
        <message>
            <source>{path_name} {too_large}</source>
            <translation type="unfinished">{path_name} {too_large}</translation>
        </message>
        <message>
            <source>reading {name}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{path} cannot be read: {error_strerror}</source>
            <translation type="unfinished">{path} lässt sich nicht lesen: {error_strerror}</translation>
        </message>
        <message>
            <source>{path} has changed since it was found; open it again</source>
            <translation type="unfinished">{path} hat sich geändert, seit die Datei gefunden wurde; öffnen Sie sie noch einmal</translation>
        </message>
        <message>
            <source>{name} read</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>reading</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>it is cut off or damaged</source>
            <translation type="unfinished">die Datei ist abgeschnitten oder beschädigt</translation>
        </message>
        <message>
            <source>slice {current} of {size}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>it holds values that are no numbers (NaN or infinite)</source>
            <translation type="unfinished">die Datei enthält Werte, die keine Zahlen sind (NaN oder unendlich)</translation>
        </message>
        <message>
            <source>it holds the value {largest:g}; {most_value:g} is the most that is read</source>
            <translation type="unfinished">die Datei enthält den Wert {largest:g}; gelesen werden höchstens {most_value:g}</translation>
        </message>
        <message>
            <source>it is not a regular file</source>
            <translation type="unfinished">das ist keine gewöhnliche Datei</translation>
        </message>
        <message>
            <source>it is {format_name}, not NIfTI</source>
            <translation type="unfinished">das ist {format_name}, nicht NIfTI</translation>
        </message>
        <message>
            <source>has sizes {shape}; one volume is read, no times or vectors</source>
            <translation type="unfinished">hat die Größen {shape}; gelesen wird ein einzelnes Volumen, keine Zeitfolgen oder Vektoren</translation>
        </message>
        <message>
            <source>has {shape} slices; a volume needs at least two</source>
            <translation type="unfinished">Schichten: {shape}; ein Volumen braucht mindestens zwei</translation>
        </message>
        <message>
            <source>holds {kind}, not one number for each voxel</source>
            <translation type="unfinished">enthält {kind}, nicht eine Zahl je Voxel</translation>
        </message>
        <message>
            <source>a picture of {columns} x {rows} pixels has no pixels</source>
            <translation type="unfinished">ein Bild von {columns} x {rows} Pixeln hat keine Pixel</translation>
        </message>
        <message>
            <source>out is {picture_dtype} of shape {picture_shape}; contiguous float32 of shape {shape} is needed</source>
            <translation type="unfinished">out ist {picture_dtype} der Form {picture_shape}; nötig ist zusammenhängendes float32 der Form {shape}</translation>
        </message>
        <message>
            <source>{view} slice {index} does not exist; slices 0 to {count} do</source>
            <translation type="unfinished">die Schicht {index} ({view}) gibt es nicht; es gibt die Schichten 0 bis {count}</translation>
        </message>
        <message>
            <source>{view} slices {first} to {last} do not exist; slices 0 to {count} do</source>
            <translation type="unfinished">die Schichten {first} bis {last} ({view}) gibt es nicht; es gibt die Schichten 0 bis {count}</translation>
        </message>
        <message>
            <source>port {settings_own_port} on {address} cannot be used to receive pictures: {error_strerror}; name another as own_port, or retrieve with C-GET</source>
            <translation type="unfinished">der Port {settings_own_port} an {address} lässt sich nicht zum Empfang von Bildern verwenden: {error_strerror}; geben Sie einen anderen als own_port an, oder rufen Sie mit C-GET ab</translation>
        </message>
        <message>
            <source>connecting to {name}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{settings_name}: {limits_problem}; nothing was taken into the library</source>
            <translation type="unfinished">{settings_name}: {limits_problem}; es wurde nichts in die Bibliothek aufgenommen</translation>
        </message>
        <message>
            <source>{settings_name} refused while {doing}: {refusal}</source>
            <translation type="unfinished">{settings_name} hat abgelehnt ({doing}): {refusal}</translation>
        </message>
        <message>
            <source>{settings_name} gave no answer while {doing}: the connection was lost, or it was silent for {settings_timeout_s:g} s; nothing was taken into the library</source>
            <translation type="unfinished">{settings_name} hat nicht geantwortet ({doing}): Die Verbindung ging verloren, oder es kam {settings_timeout_s:g} s lang nichts; es wurde nichts in die Bibliothek aufgenommen</translation>
        </message>
        <message>
            <source>{where} rejects the connection of {settings_own_title} to {settings_title}: {reason}</source>
            <translation type="unfinished">{where} lehnt die Verbindung von {settings_own_title} zu {settings_title} ab: {reason}</translation>
        </message>
        <message>
            <source>{where} supports nothing of what is needed for this request</source>
            <translation type="unfinished">{where} unterstützt nichts von dem, was diese Anfrage braucht</translation>
        </message>
        <message>
            <source>; perhaps it wants a certificate of our own (tls: certificate, key)</source>
            <translation type="unfinished">; vielleicht wird ein eigenes Zertifikat verlangt (tls: certificate, key)</translation>
        </message>
        <message>
            <source>; perhaps that port wants TLS</source>
            <translation type="unfinished">; vielleicht verlangt dieser Port TLS</translation>
        </message>
        <message>
            <source>{where} cannot be reached: something listens there, but it does not answer as a DICOM service{wish}</source>
            <translation type="unfinished">{where} ist nicht erreichbar: Dort lauscht etwas, antwortet aber nicht als DICOM-Dienst{wish}</translation>
        </message>
        <message>
            <source>{where}: {reason}</source>
            <translation type="unfinished">{where}: {reason}</translation>
        </message>
        <message>
            <source>no way leads from this computer to {settings_host}: {error_strerror}</source>
            <translation type="unfinished">von diesem Computer führt kein Weg zu {settings_host}: {error_strerror}</translation>
        </message>
        <message>
            <source>more than {most_studies} studies match; narrow the search by date or patient</source>
            <translation type="unfinished">mehr als {most_studies} Studien passen; grenzen Sie die Suche nach Datum oder Patient ein</translation>
        </message>
        <message>
            <source>{settings_name} has no such study or series</source>
            <translation type="unfinished">{settings_name} hat keine solche Studie oder Serie</translation>
        </message>
        <message>
            <source>{settings_name} cancelled the retrieval</source>
            <translation type="unfinished">{settings_name} hat den Abruf abgebrochen</translation>
        </message>
        <message>
            <source>sending the pictures</source>
            <translation type="unfinished">Senden der Bilder</translation>
        </message>
        <message>
            <source>{settings_name}: {problem}; nothing was taken into the library</source>
            <translation type="unfinished">{settings_name}: {problem}; es wurde nichts in die Bibliothek aufgenommen</translation>
        </message>
        <message>
            <source>{name} did not send {missing_pictures} of {listed_pictures} pictures; repeat the retrieval: only those are fetched{refused}</source>
            <translation type="unfinished">{name} hat nicht alle Bilder gesendet (fehlend: {missing_pictures}, gelistet: {listed_pictures}); wiederholen Sie den Abruf: Nur die fehlenden werden geholt{refused}</translation>
        </message>
        <message>
            <source>{name} sent nothing{refused}</source>
            <translation type="unfinished">{name} hat nichts gesendet{refused}</translation>
        </message>
        <message>
            <source>{settings_name} gave more than {most_pictures} answers while {doing}</source>
            <translation type="unfinished">{settings_name} gab mehr als {most_pictures} Antworten ({doing})</translation>
        </message>
        <message>
            <source>{ready} {known}pictures received</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{settings_name}: C-MOVE with TLS needs a certificate of our own (tls: certificate, key); or retrieve with C-GET</source>
            <translation type="unfinished">{settings_name}: C-MOVE mit TLS braucht ein eigenes Zertifikat (tls: certificate, key); oder rufen Sie mit C-GET ab</translation>
        </message>
        <message>
            <source>its certificate is not trusted: {error_verify_message}</source>
            <translation type="unfinished">seinem Zertifikat wird nicht vertraut: {error_verify_message}</translation>
        </message>
        <message>
            <source>no encrypted connection comes about ({reason}); is that its TLS port?</source>
            <translation type="unfinished">es kommt keine verschlüsselte Verbindung zustande ({reason}); ist das der TLS-Port?</translation>
        </message>
        <message>
            <source>it does not answer to TLS; is that its TLS port?</source>
            <translation type="unfinished">auf TLS kommt keine Antwort; ist das der TLS-Port?</translation>
        </message>
        <message>
            <source>it closes the connection when TLS begins; is that its TLS port?</source>
            <translation type="unfinished">die Verbindung wird geschlossen, sobald TLS beginnt; ist das der TLS-Port?</translation>
        </message>
        <message>
            <source>it holds no certificate in PEM</source>
            <translation type="unfinished">die Datei enthält kein Zertifikat in PEM</translation>
        </message>
        <message>
            <source>it cannot be read: {reason}</source>
            <translation type="unfinished">die Datei lässt sich nicht lesen: {reason}</translation>
        </message>
        <message>
            <source>tls {name} {file}: {reason}</source>
            <translation type="unfinished">tls {name} {file}: {reason}</translation>
        </message>
        <message>
            <source>it sent an object that is no CT or MR picture</source>
            <translation type="unfinished">es hat ein Objekt gesendet, das kein CT- oder MR-Bild ist</translation>
        </message>
        <message>
            <source>it sent a picture that it had not listed</source>
            <translation type="unfinished">es hat ein Bild gesendet, das es nicht gelistet hatte</translation>
        </message>
        <message>
            <source>it sent more than {most_pictures} pictures</source>
            <translation type="unfinished">es hat mehr als {most_pictures} Bilder gesendet</translation>
        </message>
        <message>
            <source>it sent a file of more than {largest_picture} GB</source>
            <translation type="unfinished">es hat eine Datei von mehr als {largest_picture} GB gesendet</translation>
        </message>
        <message>
            <source>the disk is full</source>
            <translation type="unfinished">der Datenträger ist voll</translation>
        </message>
        <message>
            <source>it sent two different pictures under one name</source>
            <translation type="unfinished">es hat zwei verschiedene Bilder unter einem Namen gesendet</translation>
        </message>
        <message>
            <source>it sent the same pictures again and again</source>
            <translation type="unfinished">es hat dieselben Bilder immer wieder gesendet</translation>
        </message>
        <message>
            <source>a picture cannot be kept: {error_strerror}</source>
            <translation type="unfinished">ein Bild lässt sich nicht aufbewahren: {error_strerror}</translation>
        </message>
        <message>
            <source>it sent something that is no DICOM data set</source>
            <translation type="unfinished">es hat etwas gesendet, das kein DICOM-Datensatz ist</translation>
        </message>
        <message>
            <source>it sent a picture under another one's name</source>
            <translation type="unfinished">es hat ein Bild unter dem Namen eines anderen gesendet</translation>
        </message>
        <message>
            <source>it sent a picture of another series</source>
            <translation type="unfinished">es hat ein Bild einer anderen Serie gesendet</translation>
        </message>
        <message>
            <source>it sent a picture of another study</source>
            <translation type="unfinished">es hat ein Bild einer anderen Studie gesendet</translation>
        </message>
        <message>
            <source>it sent pictures of several patients</source>
            <translation type="unfinished">es hat Bilder mehrerer Patienten gesendet</translation>
        </message>
        <message>
            <source>date {date!r}: use YYYYMMDD, or a range YYYYMMDD-YYYYMMDD</source>
            <translation type="unfinished">Datum {date!r}: Schreiben Sie YYYYMMDD, oder einen Bereich YYYYMMDD-YYYYMMDD</translation>
        </message>
        <message>
            <source>say what to look for: a patient, a date, an accession number or a study; a list of everything would be thousands of patients</source>
            <translation type="unfinished">sagen Sie, wonach gesucht wird: ein Patient, ein Datum, eine Accession-Nummer oder eine Studie; eine Liste von allem wären Tausende von Patienten</translation>
        </message>
        <message>
            <source>no PACS is configured; acus pacs add NAME --host HOST --port PORT --title AE writes {pacs_path}</source>
            <translation type="unfinished">es ist kein PACS eingerichtet; acus pacs add NAME --host HOST --port PORT --title AE schreibt {pacs_path}</translation>
        </message>
        <message>
            <source>no PACS {name!r}</source>
            <translation type="unfinished">es gibt kein PACS {name!r}</translation>
        </message>
        <message>
            <source>name one of the PACS: {names}</source>
            <translation type="unfinished">nennen Sie eines der PACS: {names}</translation>
        </message>
        <message>
            <source>it cannot process the request</source>
            <translation type="unfinished">es kann die Anfrage nicht bearbeiten</translation>
        </message>
        <message>
            <source>an unknown answer</source>
            <translation type="unfinished">eine unbekannte Antwort</translation>
        </message>
        <message>
            <source>{pacs_settings_name} sent nothing that can be read</source>
            <translation type="unfinished">{pacs_settings_name} hat nichts gesendet, was sich lesen lässt</translation>
        </message>
        <message>
            <source>this series cannot be used: {series_reason}</source>
            <translation type="unfinished">diese Serie ist nicht verwendbar: {series_reason}</translation>
        </message>
        <message>
            <source>this series cannot be used as it is: {series_reason}{offer}; what has come is kept aside for a day and not fetched again</source>
            <translation type="unfinished">diese Serie ist so nicht verwendbar: {series_reason}{offer}; was angekommen ist, bleibt einen Tag lang aufgehoben und wird nicht noch einmal geholt</translation>
        </message>
        <message>
            <source>no lesion with a safe path was found for phantom seed {seed}; take another</source>
            <translation type="unfinished">für das Phantom mit Startwert {seed} wurde keine Läsion mit einem sicheren Pfad gefunden; nehmen Sie einen anderen</translation>
        </message>
        <message>
            <source>phantom seed {seed}, {slices} slices, {rows} rows: the seed must be 0 or more, slices 2 to 2000 and rows 16 to 2048</source>
            <translation type="unfinished">Phantom mit Startwert {seed}, {slices} Schichten, {rows} Zeilen: Der Startwert muss 0 oder größer sein, möglich sind 2 bis 2000 Schichten und 16 bis 2048 Zeilen</translation>
        </message>
        <message>
            <source>phantom patient {seed}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>phantom slice {ready} of {slices}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>HighBit {high_bit} and BitsStored {bits_stored} leave the lowest {bits_below} bits of a pixel empty, and they are not; HighBit must be {right_high_bit}</source>
            <translation type="unfinished">HighBit {high_bit} und BitsStored {bits_stored} lassen unten im Pixel Bits leer (Anzahl {bits_below}), und sie sind nicht leer; HighBit muss {right_high_bit} sein</translation>
        </message>
        <message>
            <source>its compressed pixels are damaged</source>
            <translation type="unfinished">die komprimierten Pixel sind beschädigt</translation>
        </message>
        <message>
            <source>{truncated}: its compressed pixels do not end</source>
            <translation type="unfinished">{truncated}: Die komprimierten Pixel enden nicht</translation>
        </message>
        <message>
            <source>its compressed pixels are empty</source>
            <translation type="unfinished">die komprimierten Pixel sind leer</translation>
        </message>
        <message>
            <source>its {fragments} compressed fragments are not {frames} frames</source>
            <translation type="unfinished">die komprimierten Fragmente ({fragments}) ergeben keine {frames} Frames</translation>
        </message>
        <message>
            <source>it ends within its compressed pixels; read it again</source>
            <translation type="unfinished">die Datei endet mitten in den komprimierten Pixeln; lesen Sie sie noch einmal ein</translation>
        </message>
        <message>
            <source>no decoder for transfer syntax {named}</source>
            <translation type="unfinished">kein Decoder für die Transfersyntax {named}</translation>
        </message>
        <message>
            <source>its pixels are of undefined length, as only compressed ones may be (PS3.5 A.4), and its transfer syntax is {raw_names}; have it sent again</source>
            <translation type="unfinished">die Pixel haben keine festgelegte Länge, was nur komprimierte dürfen (PS3.5 A.4), und die Transfersyntax ist {raw_names}; lassen Sie die Datei noch einmal senden</translation>
        </message>
        <message>
            <source>(what stands there is no UID)</source>
            <translation type="unfinished">(was dort steht, ist keine UID)</translation>
        </message>
        <message>
            <source>{truncated}: {{size}} bytes and no pixels in them</source>
            <translation type="unfinished">{truncated}: {{size}} Byte und keine Pixel darin</translation>
        </message>
        <message>
            <source>no pixels in it (PixelData is missing)</source>
            <translation type="unfinished">keine Pixel enthalten (PixelData fehlt)</translation>
        </message>
        <message>
            <source>its pixels are compressed, and its transfer syntax is {raw_names}</source>
            <translation type="unfinished">die Pixel sind komprimiert, und die Transfersyntax ist {raw_names}</translation>
        </message>
        <message>
            <source>{contradiction}; have it sent again</source>
            <translation type="unfinished">{contradiction}; lassen Sie die Datei noch einmal senden</translation>
        </message>
        <message>
            <source>{truncated}: the last {missing} bytes of pixels are missing</source>
            <translation type="unfinished">{truncated}: Die letzten {missing} Byte der Pixel fehlen</translation>
        </message>
        <message>
            <source>{length} bytes of pixels where {needed} are needed</source>
            <translation type="unfinished">{length} Byte Pixel, nötig sind {needed}</translation>
        </message>
        <message>
            <source>{length} bytes of pixels where {needed} are needed, {times} times as many: NumberOfFrames or BitsAllocated is not what it should be</source>
            <translation type="unfinished">{length} Byte Pixel, nötig sind {needed}, das {times}-Fache: NumberOfFrames oder BitsAllocated stimmt nicht</translation>
        </message>
        <message>
            <source>its {length} bytes of pixels are not compressed, and its transfer syntax is {named}; have it sent again</source>
            <translation type="unfinished">die {length} Byte Pixel sind nicht komprimiert, und die Transfersyntax ist {named}; lassen Sie die Datei noch einmal senden</translation>
        </message>
        <message>
            <source>its sequences are nested deeper than {deepest} levels</source>
            <translation type="unfinished">die Sequenzen sind tiefer verschachtelt als {deepest} Ebenen</translation>
        </message>
        <message>
            <source>picture {picture}: pictures are counted from 1</source>
            <translation type="unfinished">Bild {picture}: Bilder werden ab 1 gezählt</translation>
        </message>
        <message>
            <source>box {column},{row},{columns},{rows}: column and row must be 0 or more, width and height 1 or more</source>
            <translation type="unfinished">Kästchen {column},{row},{columns},{rows}: Spalte und Zeile müssen 0 oder größer sein, Breite und Höhe 1 oder größer</translation>
        </message>
        <message>
            <source>there is no picture {box_picture}: the series has {count}</source>
            <translation type="unfinished">es gibt kein Bild {box_picture}: Bilder in der Serie: {count}</translation>
        </message>
        <message>
            <source>it is a secondary capture: such pictures often carry a name</source>
            <translation type="unfinished">es ist eine Secondary Capture: Solche Bilder tragen oft einen Namen</translation>
        </message>
        <message>
            <source>it is a picture of a screen (ImageType {first})</source>
            <translation type="unfinished">es ist ein Bild eines Bildschirms (ImageType {first})</translation>
        </message>
        <message>
            <source>it was converted from a film, a video or paper (ConversionType)</source>
            <translation type="unfinished">es wurde von einem Film, einem Video oder Papier übertragen (ConversionType)</translation>
        </message>
        <message>
            <source>its series is described as pictures of a screen or a dose report</source>
            <translation type="unfinished">die Serie ist als Bildschirmbilder oder Dosisbericht beschrieben</translation>
        </message>
        <message>
            <source>its pictures carry writing (BurnedInAnnotation YES), which may be a name; draw boxes over the writing (--mask COL,ROW,WIDTH,HEIGHT) or choose another series</source>
            <translation type="unfinished">die Bilder tragen Schrift (BurnedInAnnotation YES), die ein Name sein kann; zeichnen Sie Kästchen über die Schrift (--mask COL,ROW,WIDTH,HEIGHT), oder wählen Sie eine andere Serie</translation>
        </message>
        <message>
            <source>box at column {box_column}, row {box_row} lies outside the picture of {columns} × {rows} pixels</source>
            <translation type="unfinished">das Kästchen bei Spalte {box_column}, Zeile {box_row} liegt außerhalb des Bildes von {columns} × {rows} Pixeln</translation>
        </message>
        <message>
            <source>{path_name}: the preamble is not empty</source>
            <translation type="unfinished">{path_name}: Die Präambel ist nicht leer</translation>
        </message>
        <message>
            <source>{path_name}: its pixels are not those that were read</source>
            <translation type="unfinished">{path_name}: Die Pixel sind nicht die, die gelesen wurden</translation>
        </message>
        <message>
            <source>{path_name}: a text of the original header stands in it</source>
            <translation type="unfinished">{path_name}: Ein Text der ursprünglichen Kopfdaten steht darin</translation>
        </message>
        <message>
            <source>{path_name}: a name or number of the patient stands in its pixels</source>
            <translation type="unfinished">{path_name}: Ein Name oder eine Nummer des Patienten steht in den Pixeln</translation>
        </message>
        <message>
            <source>{path_name}: {name} should have been removed</source>
            <translation type="unfinished">{path_name}: {name} hätte entfernt werden müssen</translation>
        </message>
        <message>
            <source>{path_name}: {name} still has its old UID</source>
            <translation type="unfinished">{path_name}: {name} hat noch die alte UID</translation>
        </message>
        <message>
            <source>{path_name}: {name} repeats what the original said elsewhere</source>
            <translation type="unfinished">{path_name}: {name} wiederholt, was das Original an anderer Stelle sagte</translation>
        </message>
        <message>
            <source>a face may be recognisable in the 3D view (body part {part}): nothing was removed from the pictures; keep this CT where patients' pictures may be kept</source>
            <translation type="unfinished">in der 3D-Ansicht kann ein Gesicht erkennbar sein (Körperteil {part}): Aus den Bildern wurde nichts entfernt; bewahren Sie dieses CT dort auf, wo Patientenbilder liegen dürfen</translation>
        </message>
        <message>
            <source>the files' own texts speak of a head or neck: a face may be recognisable in the 3D view; nothing was removed from the pictures</source>
            <translation type="unfinished">die Texte der Dateien sprechen von Kopf oder Hals: In der 3D-Ansicht kann ein Gesicht erkennbar sein; aus den Bildern wurde nichts entfernt</translation>
        </message>
        <message>
            <source>the files do not say which body part they show: if it is the head, a face may be recognisable in the 3D view</source>
            <translation type="unfinished">die Dateien sagen nicht, welchen Körperteil sie zeigen: Ist es der Kopf, kann in der 3D-Ansicht ein Gesicht erkennbar sein</translation>
        </message>
        <message>
            <source>it cannot be read: {error_strerror}</source>
            <translation type="unfinished">die Datei lässt sich nicht lesen: {error_strerror}</translation>
        </message>
        <message>
            <source>it cannot be read ({error_name})</source>
            <translation type="unfinished">die Datei lässt sich nicht lesen ({error_name})</translation>
        </message>
        <message>
            <source>it has changed since the folder was looked at</source>
            <translation type="unfinished">die Datei hat sich geändert, seit der Ordner angesehen wurde</translation>
        </message>
        <message>
            <source>boxes can be drawn on files of one picture only</source>
            <translation type="unfinished">Kästchen lassen sich nur auf Dateien mit einem einzigen Bild zeichnen</translation>
        </message>
        <message>
            <source>it cannot be written anew ({error_name})</source>
            <translation type="unfinished">die Datei lässt sich nicht neu schreiben ({error_name})</translation>
        </message>
        <message>
            <source>file 1 of {count}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>file {current} of {count}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>checking file {current} of {count}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>file {file_number} of {count}: {error}</source>
            <translation type="unfinished">Datei {file_number} von {count}: {error}</translation>
        </message>
        <message>
            <source>the privacy key {path} cannot be read or made: {error_strerror}; pseudonyms need it: make the folder writable</source>
            <translation type="unfinished">der Datenschutz-Schlüssel {path} lässt sich nicht lesen oder anlegen: {error_strerror}; Pseudonyme brauchen ihn: Machen Sie den Ordner beschreibbar</translation>
        </message>
        <message>
            <source>the privacy key {path} has {stored_bytes} bytes, {needed_bytes} are needed; put the kept copy back, or delete it: then every patient gets a new pseudonym</source>
            <translation type="unfinished">der Datenschutz-Schlüssel {path} hat {stored_bytes} Byte, nötig sind {needed_bytes}; stellen Sie die Sicherungskopie zurück, oder löschen Sie ihn: Dann bekommt jeder Patient ein neues Pseudonym</translation>
        </message>
        <message>
            <source>{count} pictures read</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>its pixels cannot be parted from what else stands with them</source>
            <translation type="unfinished">die Pixel lassen sich nicht von dem trennen, was sonst noch bei ihnen steht</translation>
        </message>
        <message>
            <source>{path}: {tag}: no action {action!r}</source>
            <translation type="unfinished">{path}: {tag}: keine Aktion {action!r}</translation>
        </message>
        <message>
            <source>{path}: {keyword}: {form}: no such keyword or form</source>
            <translation type="unfinished">{path}: {keyword}: {form}: kein solches Schlüsselwort, keine solche Form</translation>
        </message>
        <message>
            <source>removed, because the value had another form</source>
            <translation type="unfinished">entfernt, weil der Wert eine andere Form hatte</translation>
        </message>
        <message>
            <source>private attributes removed: {private}</source>
            <translation type="unfinished">entfernte private Attribute: {private}</translation>
        </message>
        <message>
            <source>pixels blackened in {masked} files</source>
            <translation type="unfinished">Dateien mit geschwärzten Pixeln: {masked}</translation>
        </message>
        <message>
            <source>left out of the pixel data of {stripped} files: what is not pixels (comments, unused bits, bytes behind the last one)</source>
            <translation type="unfinished">aus den Pixeldaten weggelassen, was keine Pixel sind (Kommentare, ungenutzte Bits, Byte hinter dem letzten); betroffene Dateien: {stripped}</translation>
        </message>
        <message>
            <source>pixel ({column}, {row}) is outside {header_path_name}: columns 0 to {form_columns}, rows 0 to {form_rows}</source>
            <translation type="unfinished">das Pixel ({column}, {row}) liegt außerhalb von {header_path_name}: Spalten 0 bis {form_columns}, Zeilen 0 bis {form_rows}</translation>
        </message>
        <message>
            <source>{header_path}: {header_damage}</source>
            <translation type="unfinished">{header_path}: {header_damage}</translation>
        </message>
        <message>
            <source>{header_path_name} is no CT image with position, orientation, spacing and rescale; choose a file that is</source>
            <translation type="unfinished">{header_path_name} ist kein CT-Bild mit Position, Ausrichtung, Pixelabstand und Reskalierung; wählen Sie eine Datei, die eines ist</translation>
        </message>
        <message>
            <source>no file with SOPInstanceUID {sop_uid}{which} in {listing_path}</source>
            <translation type="unfinished">keine Datei mit SOPInstanceUID {sop_uid}{which} in {listing_path}</translation>
        </message>
        <message>
            <source>{listing_path} holds {usable} usable CT series; name one: {uids}</source>
            <translation type="unfinished">verwendbare CT-Serien in {listing_path}: {usable}; nennen Sie eine: {uids}</translation>
        </message>
        <message>
            <source>{label}: {reason}{offer}</source>
            <translation type="unfinished">{label}: {reason}{offer}</translation>
        </message>
        <message>
            <source>no usable CT series in {listing_path}. {reasons}</source>
            <translation type="unfinished">keine verwendbare CT-Serie in {listing_path}. {reasons}</translation>
        </message>
        <message>
            <source>{listing_path} is empty; name a folder with DICOM files</source>
            <translation type="unfinished">{listing_path} ist leer; nennen Sie einen Ordner mit DICOM-Dateien</translation>
        </message>
        <message>
            <source>no DICOM series in {listing_path}: {ignored} {files} ignored ({first_path_name}: {first_reason})</source>
            <translation type="unfinished">keine DICOM-Serie in {listing_path}: übergangen: {ignored} {files} ({first_path_name}: {first_reason})</translation>
        </message>
        <message>
            <source>no series {series_uid} in {listing_path}; it holds {valid}</source>
            <translation type="unfinished">keine Serie {series_uid} in {listing_path}; vorhanden: {valid}</translation>
        </message>
        <message>
            <source>series {series_uid} holds {count} passes over the same places; name one: {parts}</source>
            <translation type="unfinished">die Serie {series_uid} enthält {count} Durchgänge über dieselben Stellen; nennen Sie einen: {parts}</translation>
        </message>
        <message>
            <source>series {series_key} cannot be used: {series_reason}{offer}</source>
            <translation type="unfinished">die Serie {series_key} ist nicht verwendbar: {series_reason}{offer}</translation>
        </message>
        <message>
            <source>ask to {remedy} (--remedy {remedy})</source>
            <translation type="unfinished">mit der Abhilfe {remedy} (--remedy {remedy})</translation>
        </message>
        <message>
            <source>; it can be read if you {ways}</source>
            <translation type="unfinished">; sie lässt sich lesen {ways}</translation>
        </message>
        <message>
            <source>the remedy {remedy!r} does not help series {series_key}: {reason}{instead}</source>
            <translation type="unfinished">die Abhilfe {remedy!r} hilft der Serie {series_key} nicht: {reason}{instead}</translation>
        </message>
        <message>
            <source>; read it as it is (--remedy {no_remedy})</source>
            <translation type="unfinished">; lesen Sie sie, wie sie ist (--remedy {no_remedy})</translation>
        </message>
        <message>
            <source>; no remedy does</source>
            <translation type="unfinished">; keine Abhilfe hilft</translation>
        </message>
        <message>
            <source>values beyond 16 bits: reading as float32</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>has values beyond 16 bits and {too_large}</source>
            <translation type="unfinished">hat Werte jenseits von 16 Bit und {too_large}</translation>
        </message>
        <message>
            <source>; ask to {known_remedy} it</source>
            <translation type="unfinished">; nehmen Sie die Abhilfe {known_remedy}</translation>
        </message>
        <message>
            <source>series {series_key} {reason}{ask}</source>
            <translation type="unfinished">die Serie {series_key} {reason}{ask}</translation>
        </message>
        <message>
            <source>slice {current} of {count}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{count} slices read, {i} × {j} × {k} voxels taken together</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>right {right} and down {down} are not perpendicular unit vectors</source>
            <translation type="unfinished">right {right} und down {down} sind keine zueinander senkrechten Einheitsvektoren</translation>
        </message>
        <message>
            <source>right {across} and down {below} are parallel</source>
            <translation type="unfinished">right {across} und down {below} sind parallel</translation>
        </message>
        <message>
            <source>{declared_path}: {no_remedy!r} means that a series is read as it is; rename the file</source>
            <translation type="unfinished">{declared_path}: {no_remedy!r} bedeutet, dass eine Serie gelesen wird, wie sie ist; benennen Sie die Datei um</translation>
        </message>
        <message>
            <source>series {series_key} and what would be made of it need {both:.1f} GB of memory; close other programs or read a shorter series</source>
            <translation type="unfinished">die Serie {series_key} und was daraus entstünde brauchen {both:.1f} GB Speicher; schließen Sie andere Programme, oder lesen Sie eine kürzere Serie</translation>
        </message>
        <message>
            <source>slice {current} of {count} resampled</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>slices {step:g} mm apart cannot be made; ask for {finest_mm:g} to {coarsest_mm:g} mm</source>
            <translation type="unfinished">Schichten mit {step:g} mm Abstand lassen sich nicht berechnen; möglich sind {finest_mm:g} bis {coarsest_mm:g} mm</translation>
        </message>
        <message>
            <source>{series_slices_path} says nothing of its place</source>
            <translation type="unfinished">{series_slices_path} sagt nichts über seine Lage</translation>
        </message>
        <message>
            <source>straightened from a gantry tilt of {grid_tilt_deg:.1f}°</source>
            <translation type="unfinished">aus einer Gantry-Neigung von {grid_tilt_deg:.1f}° gerade gerichtet</translation>
        </message>
        <message>
            <source>resampled from slices {narrowest_mm:.3g} to {widest_mm:.3g} mm apart to {step:.3g} mm</source>
            <translation type="unfinished">neu berechnet aus Schichten mit {narrowest_mm:.3g} bis {widest_mm:.3g} mm Abstand auf {step:.3g} mm</translation>
        </message>
        <message>
            <source>{empty} {gaps} of missing slices left empty</source>
            <translation type="unfinished">fehlende Schichten leer gelassen: {empty} {gaps}</translation>
        </message>
        <message>
            <source>there is no volume to write to</source>
            <translation type="unfinished">es gibt kein Volumen zum Beschreiben</translation>
        </message>
        <message>
            <source>{header_path} gives no Hounsfield units</source>
            <translation type="unfinished">{header_path} liefert keine Hounsfield-Einheiten</translation>
        </message>
        <message>
            <source>the table position {centre_mm} is not a number</source>
            <translation type="unfinished">die Tischposition {centre_mm} ist keine Zahl</translation>
        </message>
        <message>
            <source>{slices} slices: a scan has {fewest} to {most}</source>
            <translation type="unfinished">Schichten: {slices}; ein Scan hat {fewest} bis {most}</translation>
        </message>
        <message>
            <source>slices of {slice_mm:g} mm: {thinnest_mm:g} to {thickest_mm:g} mm are valid</source>
            <translation type="unfinished">Schichten von {slice_mm:g} mm: Gültig sind {thinnest_mm:g} bis {thickest_mm:g} mm</translation>
        </message>
        <message>
            <source>the needle's hub and tip are both at {tip_mm}</source>
            <translation type="unfinished">Ansatz und Spitze der Nadel liegen beide bei {tip_mm}</translation>
        </message>
        <message>
            <source>a needle of radius {radius_mm} mm cannot be drawn</source>
            <translation type="unfinished">eine Nadel mit dem Radius {radius_mm} mm lässt sich nicht zeichnen</translation>
        </message>
        <message>
            <source>direction cosines not of length one: taken as they are written</source>
            <translation type="unfinished">Richtungskosinus nicht von der Länge eins: übernommen, wie sie geschrieben sind</translation>
        </message>
        <message>
            <source>{files} bytes behind the pixels, which are left out</source>
            <translation type="unfinished">Byte hinter den Pixeln werden weggelassen ({files})</translation>
        </message>
        <message>
            <source>slices lie {between:.1f} mm apart and are {thickness:.3g} mm thick: what is shown between them is interpolated, nothing there was scanned</source>
            <translation type="unfinished">die Schichten liegen {between:.1f} mm auseinander und sind {thickness:.3g} mm dick: Was dazwischen gezeigt wird, ist interpoliert, dort wurde nichts gescannt</translation>
        </message>
        <message>
            <source>not CT (modality {others})</source>
            <translation type="unfinished">kein CT (Modalität {others})</translation>
        </message>
        <message>
            <source>no photometric interpretation</source>
            <translation type="unfinished">keine Angabe zu PhotometricInterpretation</translation>
        </message>
        <message>
            <source>not a CT image but a picture ({photometric}, secondary capture)</source>
            <translation type="unfinished">kein CT-Bild, sondern ein anderes Bild ({photometric}, Secondary Capture)</translation>
        </message>
        <message>
            <source>secondary capture, not an original CT image</source>
            <translation type="unfinished">Secondary Capture, kein originales CT-Bild</translation>
        </message>
        <message>
            <source>localizer (scout view), not a volume</source>
            <translation type="unfinished">Übersichtsaufnahme (Localizer, Scout), kein Volumen</translation>
        </message>
        <message>
            <source>multi-frame file ({frames} frames) that does not say where each of them lies</source>
            <translation type="unfinished">Multiframe-Datei ({frames} Frames), die nicht sagt, wo jeder davon liegt</translation>
        </message>
        <message>
            <source>not CT but MR, and not an MR image</source>
            <translation type="unfinished">kein CT, sondern MR, und kein MR-Bild</translation>
        </message>
        <message>
            <source>not a CT image</source>
            <translation type="unfinished">kein CT-Bild</translation>
        </message>
        <message>
            <source>a mosaic: many slices side by side in one picture, which says of none where it lies</source>
            <translation type="unfinished">ein Mosaik: viele Schichten nebeneinander in einem Bild, das von keiner sagt, wo sie liegt</translation>
        </message>
        <message>
            <source>{display_name} is {cut_first_damage}{more}; have it sent again</source>
            <translation type="unfinished">{display_name}: {cut_first_damage}{more}; lassen Sie die Datei noch einmal senden</translation>
        </message>
        <message>
            <source>{form_bits_allocated} bits per pixel are not supported (8 or 16 are)</source>
            <translation type="unfinished">Bits je Pixel: {form_bits_allocated}; unterstützt werden 8 und 16</translation>
        </message>
        <message>
            <source>BitsStored {form_bits_stored}, HighBit {form_high_bit} and BitsAllocated {form_bits_allocated} contradict each other</source>
            <translation type="unfinished">BitsStored {form_bits_stored}, HighBit {form_high_bit} und BitsAllocated {form_bits_allocated} widersprechen einander</translation>
        </message>
        <message>
            <source>no pixels: {form_columns} columns × {form_rows} rows</source>
            <translation type="unfinished">keine Pixel: {form_columns} Spalten × {form_rows} Zeilen</translation>
        </message>
        <message>
            <source>no Hounsfield units (RescaleSlope and RescaleIntercept missing, or another unit)</source>
            <translation type="unfinished">keine Hounsfield-Einheiten (RescaleSlope und RescaleIntercept fehlen, oder eine andere Einheit)</translation>
        </message>
        <message>
            <source>ImagePositionPatient, ImageOrientationPatient or PixelSpacing missing</source>
            <translation type="unfinished">ImagePositionPatient, ImageOrientationPatient oder PixelSpacing fehlt</translation>
        </message>
        <message>
            <source>mixed image sizes: </source>
            <translation type="unfinished">verschiedene Bildgrößen: </translation>
        </message>
        <message>
            <source>a single slice; a volume needs at least two</source>
            <translation type="unfinished">eine einzige Schicht; ein Volumen braucht mindestens zwei</translation>
        </message>
        <message>
            <source>{count} series</source>
            <translation type="unfinished">Serien: {count}</translation>
        </message>
        <message>
            <source>some of its files name no frame of reference: they lie together only if whoever wrote them left it out</source>
            <translation type="unfinished">manche der Dateien nennen kein Bezugssystem (FrameOfReference): Sie gehören nur zusammen, wenn es beim Schreiben weggelassen wurde</translation>
        </message>
        <message>
            <source>its files name {frames} frames of reference: they lie together only if whoever de-identified them gave each a number of its own</source>
            <translation type="unfinished">die Dateien nennen {frames} Bezugssysteme (FrameOfReference): Sie gehören nur zusammen, wenn beim De-Identifizieren jede ein eigenes bekam</translation>
        </message>
        <message>
            <source>a picture of {values_shape} values on {place} px cannot be drawn</source>
            <translation type="unfinished">ein Bild mit {values_shape} Werten auf {place} px lässt sich nicht zeichnen</translation>
        </message>
        <message>
            <source>skin found</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>a slab of {thickness_mm} mm cannot be shown; it must be above 0 and at most {thickest_mm:g} mm</source>
            <translation type="unfinished">ein Slab von {thickness_mm} mm lässt sich nicht anzeigen; er muss über 0 und höchstens {thickest_mm:g} mm dick sein</translation>
        </message>
        <message>
            <source>files of two patients: {name} differs under one PatientID and StudyInstanceUID; put the files of each patient into a folder of their own</source>
            <translation type="unfinished">Dateien zweier Patienten: {name} ist unter einer PatientID und StudyInstanceUID verschieden; legen Sie die Dateien jedes Patienten in einen eigenen Ordner</translation>
        </message>
        <message>
            <source>set aside, as {role}: {names}{more}</source>
            <translation type="unfinished">beiseitegelegt ({role}): {names}{more}</translation>
        </message>
        <message>
            <source>of another direction than the slices</source>
            <translation type="unfinished">andere Richtung als die Schichten</translation>
        </message>
        <message>
            <source>of another size than the slices</source>
            <translation type="unfinished">andere Größe als die Schichten</translation>
        </message>
        <message>
            <source>of another pixel spacing than the slices</source>
            <translation type="unfinished">anderer Pixelabstand als die Schichten</translation>
        </message>
        <message>
            <source>it is damaged ({error_name})</source>
            <translation type="unfinished">die Datei ist beschädigt ({error_name})</translation>
        </message>
        <message>
            <source>it holds {files} files; {bounds_files} are unpacked at most</source>
            <translation type="unfinished">Dateien im Archiv: {files}; höchstens {bounds_files} werden entpackt</translation>
        </message>
        <message>
            <source>it would grow {growth:.0f} times to {unpacked_gb:.1f} GB: no archive of pictures does that; unpack it yourself if you trust it</source>
            <translation type="unfinished">es würde um das {growth:.0f}-Fache auf {unpacked_gb:.1f} GB wachsen: Das tut kein Bildarchiv; entpacken Sie es selbst, wenn Sie ihm trauen</translation>
        </message>
        <message>
            <source>it unpacks to {unpacked_gb:.1f} GB and {free_gb:.1f} GB are free in the temporary folder; make room, or unpack it elsewhere and open that folder</source>
            <translation type="unfinished">es ist entpackt {unpacked_gb:.1f} GB groß, und im temporären Ordner sind {free_gb:.1f} GB frei; schaffen Sie Platz, oder entpacken Sie es anderswo und öffnen Sie jenen Ordner</translation>
        </message>
        <message>
            <source>unpacking {current} of {count}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>leads out of the archive</source>
            <translation type="unfinished">führt aus dem Archiv hinaus</translation>
        </message>
        <message>
            <source>has a name that is no file's</source>
            <translation type="unfinished">hat einen Namen, den keine Datei haben kann</translation>
        </message>
        <message>
            <source>a link, not a file</source>
            <translation type="unfinished">ein Link, keine Datei</translation>
        </message>
        <message>
            <source>encrypted; unpack the archive yourself</source>
            <translation type="unfinished">verschlüsselt; entpacken Sie das Archiv selbst</translation>
        </message>
        <message>
            <source>packed in a way that is not read (stored and deflated are)</source>
            <translation type="unfinished">auf eine Art gepackt, die nicht gelesen wird (nur „stored“ und „deflated“)</translation>
        </message>
        <message>
            <source>it holds {records} records</source>
            <translation type="unfinished">die Datei enthält {records} Einträge</translation>
        </message>
        <message>
            <source>{path} cannot be unpacked: {error_strerror}</source>
            <translation type="unfinished">{path} lässt sich nicht entpacken: {error_strerror}</translation>
        </message>
        <message>
            <source>{path} cannot be unpacked: {reason}</source>
            <translation type="unfinished">{path} lässt sich nicht entpacken: {reason}</translation>
        </message>
        <message>
            <source>{path} cannot be read: {reason}</source>
            <translation type="unfinished">{path} lässt sich nicht lesen: {reason}</translation>
        </message>
        <message>
            <source>{path} is a file, and no DICOM, DICOMDIR, NIfTI or zip file; name the folder it is in</source>
            <translation type="unfinished">{path} ist eine Datei, aber keine DICOM-, DICOMDIR-, NIfTI- oder ZIP-Datei; nennen Sie den Ordner, in dem sie liegt</translation>
        </message>
        <message>
            <source>{root} does not exist; name a folder with DICOM files</source>
            <translation type="unfinished">{root} gibt es nicht; nennen Sie einen Ordner mit DICOM-Dateien</translation>
        </message>
        <message>
            <source>{root} is no folder; name one with DICOM files</source>
            <translation type="unfinished">{root} ist kein Ordner; nennen Sie einen mit DICOM-Dateien</translation>
        </message>
        <message>
            <source>{root} cannot be read: {reason}</source>
            <translation type="unfinished">{root} lässt sich nicht lesen: {reason}</translation>
        </message>
        <message>
            <source>{count} files found</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{path} cannot be read as a DICOMDIR ({error}); open its folder instead</source>
            <translation type="unfinished">{path} lässt sich nicht als DICOMDIR lesen ({error}); öffnen Sie stattdessen den Ordner</translation>
        </message>
        <message>
            <source>mixed orientations: {first_orientation} and {plane_orientation}</source>
            <translation type="unfinished">verschiedene Ausrichtungen: {first_orientation} und {plane_orientation}</translation>
        </message>
        <message>
            <source>mixed pixel spacings: {first_pixel_spacing_mm} and {plane_pixel_spacing_mm} mm</source>
            <translation type="unfinished">verschiedene Pixelabstände: {first_pixel_spacing_mm} und {plane_pixel_spacing_mm} mm</translation>
        </message>
        <message>
            <source>doubled slices: {lower_slice} and {upper_slice} lie at the same position and differ{more}</source>
            <translation type="unfinished">doppelte Schichten: {lower_slice} und {upper_slice} liegen an derselben Stelle und sind verschieden{more}</translation>
        </message>
        <message>
            <source>slices turned against each other: the corners of {names} lie {slices_turned_mm:.3f} mm off (limit {tolerance_mm:g} mm)</source>
            <translation type="unfinished">Schichten gegeneinander verdreht: Die Ecken von {names} liegen {slices_turned_mm:.3f} mm daneben (Grenze {tolerance_mm:g} mm)</translation>
        </message>
        <message>
            <source>gap: {times} {plural} missing between {slice_before} and {slice_after} ({gap:.3f} mm apart where {usual:.3f} mm is usual)</source>
            <translation type="unfinished">Lücke: {times} {plural} nicht vorhanden zwischen {slice_before} und {slice_after} (Abstand {gap:.3f} mm, üblich {usual:.3f} mm)</translation>
        </message>
        <message>
            <source>slices shifted sideways against each other: up to {largest_mm:.3f} mm off a straight stack at {names} (limit {tolerance_mm:g} mm)</source>
            <translation type="unfinished">Schichten seitlich gegeneinander verschoben: bis zu {largest_mm:.3f} mm neben einem geraden Stapel bei {names} (Grenze {tolerance_mm:g} mm)</translation>
        </message>
        <message>
            <source>uneven spacing: slices {narrowest_mm:.3f} to {widest_mm:.3f} mm apart, up to {largest_mm:.3f} mm off an even grid at {names} (limit {tolerance_mm:g} mm)</source>
            <translation type="unfinished">ungleichmäßiger Abstand: Schichten {narrowest_mm:.3f} bis {widest_mm:.3f} mm auseinander, bis zu {largest_mm:.3f} mm neben einem gleichmäßigen Raster bei {names} (Grenze {tolerance_mm:g} mm)</translation>
        </message>
        <message>
            <source>this CT lacks what a DICOM segmentation has to repeat of it ({lacking}); write a .seg.nrrd instead</source>
            <translation type="unfinished">diesem CT fehlt, was eine DICOM-Segmentierung von ihm wiederholen muss ({lacking}); schreiben Sie stattdessen eine .seg.nrrd</translation>
        </message>
        <message>
            <source>file {file_number} of this CT is gone or damaged ({brief})</source>
            <translation type="unfinished">die Datei {file_number} dieses CT fehlt jetzt oder ist beschädigt ({brief})</translation>
        </message>
        <message>
            <source>distances of {name}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>no voxel has {low:g} to {high:g} HU: widen the threshold</source>
            <translation type="unfinished">kein Voxel hat {low:g} bis {high:g} HU: Erweitern Sie den Schwellenbereich</translation>
        </message>
        <message>
            <source>the point to grow from lies outside the CT</source>
            <translation type="unfinished">der Startpunkt des Wachstums liegt außerhalb des CT</translation>
        </message>
        <message>
            <source>the point has {own:.0f} HU, which is not from {low:g} to {high:g}: click inside the structure, or move the limits</source>
            <translation type="unfinished">der Punkt hat {own:.0f} HU und liegt damit nicht zwischen {low:g} und {high:g}: Klicken Sie in die Struktur, oder verschieben Sie die Grenzen</translation>
        </message>
        <message>
            <source>{path_name}: {error}</source>
            <translation type="unfinished">{path_name}: {error}</translation>
        </message>
        <message>
            <source>structures placed</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{item_name} lies outside this CT</source>
            <translation type="unfinished">{item_name} liegt außerhalb dieses CT</translation>
        </message>
        <message>
            <source>{path_name}: structures are written as .seg.nrrd (3D Slicer) or .dcm (DICOM SEG)</source>
            <translation type="unfinished">{path_name}: Strukturen werden als .seg.nrrd (3D Slicer) oder .dcm (DICOM SEG) geschrieben</translation>
        </message>
        <message>
            <source>there are no structures to write</source>
            <translation type="unfinished">es gibt keine Strukturen zu schreiben</translation>
        </message>
        <message>
            <source>this volume is not slice for slice that of DICOM files (it was resampled, or comes from another format); write a .seg.nrrd instead</source>
            <translation type="unfinished">dieses Volumen entspricht nicht Schicht für Schicht den DICOM-Dateien (es wurde neu berechnet oder kommt aus einem anderen Format); schreiben Sie stattdessen eine .seg.nrrd</translation>
        </message>
        <message>
            <source>{path} cannot be written: {error_strerror}</source>
            <translation type="unfinished">{path} lässt sich nicht schreiben: {error_strerror}</translation>
        </message>
        <message>
            <source>{path_name} has sizes {image_shape}; three are read</source>
            <translation type="unfinished">{path_name} hat die Größen {image_shape}; gelesen werden drei</translation>
        </message>
        <message>
            <source>{path_name} cannot be read as NIfTI ({fault})</source>
            <translation type="unfinished">{path_name} lässt sich nicht als NIfTI lesen ({fault})</translation>
        </message>
        <message>
            <source>{path_name} holds fractions; a label map holds whole numbers</source>
            <translation type="unfinished">{path_name} enthält gebrochene Zahlen; eine Labelkarte enthält ganze Zahlen</translation>
        </message>
        <message>
            <source>{path_name} holds {labels} labels above 0; a label map holds 1 to {most_labels}</source>
            <translation type="unfinished">Labels über 0 in {path_name}: {labels}; eine Labelkarte enthält 1 bis {most_labels}</translation>
        </message>
        <message>
            <source>{path_name} is {format_name}, not NIfTI</source>
            <translation type="unfinished">{path_name} ist {format_name}, nicht NIfTI</translation>
        </message>
        <message>
            <source>{path_name} does not say where it lies (neither sform nor qform is set)</source>
            <translation type="unfinished">{path_name} sagt nicht, wo es liegt (weder sform noch qform ist gesetzt)</translation>
        </message>
        <message>
            <source>{path_name} lies further away than {furthest_mm:g} mm</source>
            <translation type="unfinished">{path_name} liegt weiter als {furthest_mm:g} mm entfernt</translation>
        </message>
        <message>
            <source>{path_name}: its axes span no volume</source>
            <translation type="unfinished">{path_name}: Die Achsen spannen kein Volumen auf</translation>
        </message>
        <message>
            <source>{path_name} is not a regular file</source>
            <translation type="unfinished">{path_name} ist keine gewöhnliche Datei</translation>
        </message>
        <message>
            <source>no file of structures</source>
            <translation type="unfinished">keine Datei mit Strukturen</translation>
        </message>
        <message>
            <source>{path_name} cannot be read ({brief})</source>
            <translation type="unfinished">{path_name} lässt sich nicht lesen ({brief})</translation>
        </message>
        <message>
            <source>no structures</source>
            <translation type="unfinished">keine Strukturdatei</translation>
        </message>
        <message>
            <source>of an unknown SOP class</source>
            <translation type="unfinished">von unbekannter SOP-Klasse</translation>
        </message>
        <message>
            <source>{path_name} is {found_format}; DICOM SEG, RTSTRUCT, .seg.nrrd and NIfTI labels are read</source>
            <translation type="unfinished">{path_name} ist {found_format}; gelesen werden DICOM SEG, RTSTRUCT, .seg.nrrd und NIfTI-Labels</translation>
        </message>
        <message>
            <source>structure {current} of {count}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>the structures in the file are empty: nothing is drawn in them</source>
            <translation type="unfinished">die Strukturen in der Datei sind leer: In ihnen ist nichts gezeichnet</translation>
        </message>
        <message>
            <source>none of the structures in the file lies in this CT: they belong to another patient or another scan</source>
            <translation type="unfinished">keine der Strukturen in der Datei liegt in diesem CT: Sie gehören zu einem anderen Patienten oder einem anderen Scan</translation>
        </message>
        <message>
            <source>the file names no frame of reference: placed by its coordinates alone</source>
            <translation type="unfinished">die Datei nennt kein Bezugssystem: nur nach ihren Koordinaten platziert</translation>
        </message>
        <message>
            <source>the file names another frame of reference (…{named}) than this CT (…{own}), but also this very series as the one that it was drawn on: placed by its coordinates; check that the outlines fit the picture</source>
            <translation type="unfinished">die Datei nennt ein anderes Bezugssystem (…{named}) als dieses CT (…{own}), aber auch genau diese Serie als die, auf der gezeichnet wurde: nach ihren Koordinaten platziert; prüfen Sie, ob die Umrisse zum Bild passen</translation>
        </message>
        <message>
            <source>the structures were drawn on another frame of reference (…{named}) than that of this CT (…{own}), and the file does not name this series: open the CT that they belong to</source>
            <translation type="unfinished">die Strukturen wurden in einem anderen Bezugssystem (…{named}) gezeichnet als dem dieses CT (…{own}), und die Datei nennt diese Serie nicht: Öffnen Sie das CT, zu dem sie gehören</translation>
        </message>
        <message>
            <source>{labelled_name} is empty in the file and was left out</source>
            <translation type="unfinished">{labelled_name} ist in der Datei leer und wurde weggelassen</translation>
        </message>
        <message>
            <source>{labelled_name} lies outside this CT and was left out</source>
            <translation type="unfinished">{labelled_name} liegt außerhalb dieses CT und wurde weggelassen</translation>
        </message>
        <message>
            <source>{outside:.0f} % of {name} lie outside this CT</source>
            <translation type="unfinished">{outside:.0f} % von {name} liegen außerhalb dieses CT</translation>
        </message>
        <message>
            <source>{name} has {here:.2f} ml on the grid of this CT, {there:.2f} ml in the file</source>
            <translation type="unfinished">{name} hat {here:.2f} ml im Raster dieses CT, {there:.2f} ml in der Datei</translation>
        </message>
        <message>
            <source>{name}: {count} {contours} {reason} left out</source>
            <translation type="unfinished">{name}: weggelassen: {count} {contours} {reason}</translation>
        </message>
        <message>
            <source>its contours spread over {columns} × {rows} × {slices} voxels</source>
            <translation type="unfinished">die Konturen erstrecken sich über {columns} × {rows} × {slices} Voxel</translation>
        </message>
        <message>
            <source>contour that is</source>
            <translation type="unfinished">Kontur</translation>
        </message>
        <message>
            <source>contours that are</source>
            <translation type="unfinished">Konturen</translation>
        </message>
        <message>
            <source>{repeated} {times} in the file twice counted once</source>
            <translation type="unfinished">in der Datei doppelt vorhanden, nur einmal gezählt: {repeated} {times}</translation>
        </message>
        <message>
            <source>contours that cross one another were joined</source>
            <translation type="unfinished">Konturen, die einander kreuzen, wurden vereinigt</translation>
        </message>
        <message>
            <source>{path_name} holds no closed contour that can be used{reason}</source>
            <translation type="unfinished">{path_name} enthält keine verwendbare geschlossene Kontur{reason}</translation>
        </message>
        <message>
            <source>{path_name} is no whole RT Structure Set ({brief})</source>
            <translation type="unfinished">{path_name} ist kein vollständiges RT Structure Set ({brief})</translation>
        </message>
        <message>
            <source>its SpacingBetweenSlices ({between:g} mm) contradicts its frames (at least {least_gap_mm:.3g} mm apart): each frame was placed where it says itself</source>
            <translation type="unfinished">SpacingBetweenSlices ({between:g} mm) widerspricht den Frames (mindestens {least_gap_mm:.3g} mm auseinander): Jeder Frame wurde dort platziert, wo er selbst es angibt</translation>
        </message>
        <message>
            <source>it spreads over </source>
            <translation type="unfinished">Ausdehnung: </translation>
        </message>
        <message>
            <source>{path_name} cannot be read as NRRD ({fault})</source>
            <translation type="unfinished">{path_name} lässt sich nicht als NRRD lesen ({fault})</translation>
        </message>
        <message>
            <source>{path_name} holds {values_dtype} values; a label map holds whole numbers</source>
            <translation type="unfinished">{path_name} enthält Werte vom Typ {values_dtype}; eine Labelkarte enthält ganze Zahlen</translation>
        </message>
        <message>
            <source>{path_name} keeps its data in other files; only attached data are read</source>
            <translation type="unfinished">{path_name} hat seine Daten in anderen Dateien; gelesen werden nur enthaltene Daten</translation>
        </message>
        <message>
            <source>{path_name} has sizes {sizes}; three of a label map, and layers, are read</source>
            <translation type="unfinished">{path_name} hat die Größen {sizes}; gelesen werden die drei einer Labelkarte, dazu Ebenen</translation>
        </message>
        <message>
            <source>{path_name} does not say where it lies: space {space!r}, {directions_shape} directions; left-posterior-superior or its like is needed</source>
            <translation type="unfinished">{path_name} sagt nicht, wo es liegt: space {space!r}, Richtungen {directions_shape}; nötig ist left-posterior-superior oder Ähnliches</translation>
        </message>
        <message>
            <source>{path_name} has {spatial} axes in space; 3 are needed</source>
            <translation type="unfinished">räumliche Achsen in {path_name}: {spatial}; nötig sind 3</translation>
        </message>
        <message>
            <source>{path_name} holds {labels} labels: not a label map</source>
            <translation type="unfinished">Labels in {path_name}: {labels}; das ist keine Labelkarte</translation>
        </message>
        <message>
            <source>{path_name}, segment {segment_number}: its layer or label is no whole number</source>
            <translation type="unfinished">{path_name}, Segment {segment_number}: Ebene oder Label ist keine ganze Zahl</translation>
        </message>
        <message>
            <source>{path_name}, segment {segment_number}: layer {layer} of {layers}</source>
            <translation type="unfinished">{path_name}, Segment {segment_number}: Ebene {layer} von {layers}</translation>
        </message>
        <message>
            <source>{path_name} is big endian; DICOM segmentations are read in little endian only</source>
            <translation type="unfinished">{path_name} ist big endian; DICOM-Segmentierungen werden nur als little endian gelesen</translation>
        </message>
        <message>
            <source>{path_name} {error}</source>
            <translation type="unfinished">{path_name} {error}</translation>
        </message>
        <message>
            <source>{path_name} cannot be read as a DICOM segmentation ({brief})</source>
            <translation type="unfinished">{path_name} lässt sich nicht als DICOM-Segmentierung lesen ({brief})</translation>
        </message>
        <message>
            <source>has no SegmentationType that is read: {types}</source>
            <translation type="unfinished">hat keinen SegmentationType, der gelesen wird: {types}</translation>
        </message>
        <message>
            <source>has {dataset_bits_allocated} bits per pixel; 1, 8, 16 are read</source>
            <translation type="unfinished">hat {dataset_bits_allocated} Bit je Pixel; gelesen werden 1, 8, 16</translation>
        </message>
        <message>
            <source>holds no frame that says where it lies</source>
            <translation type="unfinished">enthält keinen Frame, der sagt, wo er liegt</translation>
        </message>
        <message>
            <source>holds no pixels that can be read: it is cut short or damaged</source>
            <translation type="unfinished">enthält keine lesbaren Pixel: abgeschnitten oder beschädigt</translation>
        </message>
        <message>
            <source>{name!r} is no name for a structure: 1 to {longest_name} characters are</source>
            <translation type="unfinished">{name!r} ist kein Name für eine Struktur: Möglich sind 1 bis {longest_name} Zeichen</translation>
        </message>
        <message>
            <source>warning distance {warn_mm:g} mm of {name}: 0 to 50 mm are</source>
            <translation type="unfinished">Warnabstand {warn_mm:g} mm von {name}: Möglich sind 0 bis 50 mm</translation>
        </message>
        <message>
            <source>structure {name} holds no voxel of this CT</source>
            <translation type="unfinished">die Struktur {name} enthält kein Voxel dieses CT</translation>
        </message>
        <message>
            <source>mask of {mask_shape} voxels on a CT of {volume_hu_shape}</source>
            <translation type="unfinished">Maske mit {mask_shape} Voxeln auf einem CT mit {volume_hu_shape}</translation>
        </message>
        <message>
            <source>a structure needs at least one voxel</source>
            <translation type="unfinished">eine Struktur braucht mindestens ein Voxel</translation>
        </message>
        <message>
            <source>structure {double_name} is there twice: rename one</source>
            <translation type="unfinished">die Struktur {double_name} ist zweimal vorhanden: Benennen Sie eine um</translation>
        </message>
        <message>
            <source>there is no structure {name!r}; there are: {names}</source>
            <translation type="unfinished">es gibt keine Struktur {name!r}; vorhanden: {names}</translation>
        </message>
        <message>
            <source>series {series_key} has no slices to show</source>
            <translation type="unfinished">die Serie {series_key} hat keine Schichten zum Anzeigen</translation>
        </message>
        <message>
            <source>the pixels of {header_path_name} are no grey picture</source>
            <translation type="unfinished">die Pixel von {header_path_name} sind kein Graubild</translation>
        </message>
        <message>
            <source>{header_path_name} is {form_columns} × {form_rows} pixels</source>
            <translation type="unfinished">{header_path_name} hat {form_columns} × {form_rows} Pixel</translation>
        </message>
        <message>
            <source>{name}{inside}, no Hounsfield units</source>
            <translation type="unfinished">{name}{inside}, keine Hounsfield-Einheiten</translation>
        </message>
        <message>
            <source>by ImageType these are Hounsfield units of one material only, not of the body</source>
            <translation type="unfinished">laut ImageType sind dies Hounsfield-Einheiten eines einzigen Materials, nicht des Körpers</translation>
        </message>
        <message>
            <source>by ImageType values were changed to make a material stand out</source>
            <translation type="unfinished">laut ImageType wurden Werte geändert, um ein Material hervorzuheben</translation>
        </message>
        <message>
            <source>no Hounsfield units: RescaleType is {unit_name}, where HU is read</source>
            <translation type="unfinished">keine Hounsfield-Einheiten: RescaleType ist {unit_name}, gelesen wird HU</translation>
        </message>
        <message>
            <source>no Hounsfield units that the file vouches for: MultienergyCTAcquisition is YES, and then RescaleType must say what the values are; it is missing</source>
            <translation type="unfinished">keine Hounsfield-Einheiten, für die die Datei einsteht: MultienergyCTAcquisition ist YES, und dann muss RescaleType sagen, was die Werte sind; es fehlt</translation>
        </message>
        <message>
            <source>window width {width} / level {level} HU: the width must be {minimum_width:g} to {limit:g} and the level within ±{limit:g}</source>
            <translation type="unfinished">Fensterung mit Breite {width} / Mitte {level} HU: Die Breite muss {minimum_width:g} bis {limit:g} sein, die Mitte innerhalb von ±{limit:g} liegen</translation>
        </message>
        <message>
            <source>it needs more than {size} MB of memory to be read</source>
            <translation type="unfinished">die Datei braucht mehr als {size} MB Arbeitsspeicher zum Lesen</translation>
        </message>
        <message>
            <source>it cannot be read ({kind})</source>
            <translation type="unfinished">die Datei lässt sich nicht lesen ({kind})</translation>
        </message>
        <message>
            <source>talked nonsense</source>
            <translation type="unfinished">antwortete Unsinn</translation>
        </message>
        <message>
            <source>damaged or hostile file: the process that read it {reason}</source>
            <translation type="unfinished">beschädigte oder bösartige Datei: Der Prozess, der sie las, {reason}</translation>
        </message>
        <message>
            <source>the memory beside a message is of no use</source>
            <translation type="unfinished">der Speicher neben einer Nachricht ist unbrauchbar</translation>
        </message>
        <message>
            <source>an array beside a message lies outside its memory</source>
            <translation type="unfinished">ein Array neben einer Nachricht liegt außerhalb ihres Speichers</translation>
        </message>
        <message>
            <source>an array beside a message is none</source>
            <translation type="unfinished">ein Array neben einer Nachricht ist keines</translation>
        </message>
        <message>
            <source>a message of {length} bytes</source>
            <translation type="unfinished">eine Nachricht von {length} Byte</translation>
        </message>
        <message>
            <source>no file descriptor came</source>
            <translation type="unfinished">es kam kein Dateideskriptor</translation>
        </message>
        <message>
            <source>{name} is no number</source>
            <translation type="unfinished">{name} ist keine Zahl</translation>
        </message>
        <message>
            <source>the process that reads foreign files {lost}</source>
            <translation type="unfinished">der Prozess, der fremde Dateien liest, {lost}</translation>
        </message>
        <message>
            <source>the process that reads foreign files {lost} before it was ready; its memory or its installation may fail: see `acus check`, or install the program again</source>
            <translation type="unfinished">der Prozess, der fremde Dateien liest, {lost}, bevor er bereit war; vielleicht ist sein Speicher oder seine Installation fehlerhaft: Sehen Sie mit `acus check` nach, oder installieren Sie das Programm neu</translation>
        </message>
        <message>
            <source>: it gave itself up, out of memory or in a state that cannot be</source>
            <translation type="unfinished">: Er gab selbst auf, ohne Speicher oder in einem unmöglichen Zustand</translation>
        </message>
        <message>
            <source>: it crashed</source>
            <translation type="unfinished">: Er stürzte ab</translation>
        </message>
        <message>
            <source>: by the system when memory ran out, or by somebody</source>
            <translation type="unfinished">: vom System, als der Speicher ausging, oder von jemandem</translation>
        </message>
        <message>
            <source>: it computed for longer than any file may</source>
            <translation type="unfinished">: Er rechnete länger, als eine Datei es darf</translation>
        </message>
        <message>
            <source>no answer</source>
            <translation type="unfinished">gab keine Antwort</translation>
        </message>
        <message>
            <source>talked nonsense ({error})</source>
            <translation type="unfinished">antwortete Unsinn ({error})</translation>
        </message>
        <message>
            <source>was not ready within {ready_seconds:.0f} s</source>
            <translation type="unfinished">war nach {ready_seconds:.0f} s nicht bereit</translation>
        </message>
        <message>
            <source>took longer than {allowed_seconds:.1f} s of computing</source>
            <translation type="unfinished">rechnete länger als {allowed_seconds:.1f} s</translation>
        </message>
        <message>
            <source>waited longer than {allowed_clock_seconds:.0f} s for it</source>
            <translation type="unfinished">wartete länger als {allowed_clock_seconds:.0f} s darauf</translation>
        </message>
        <message>
            <source>closed its connection</source>
            <translation type="unfinished">schloss seine Verbindung</translation>
        </message>
        <message>
            <source>ended with code {code}</source>
            <translation type="unfinished">endete mit Code {code}</translation>
        </message>
        <message>
            <source>was ended by {name}{reason}</source>
            <translation type="unfinished">wurde durch {name} beendet{reason}</translation>
        </message>
        <message>
            <source>the process that reads foreign files cannot be started: {error_strerror}</source>
            <translation type="unfinished">der Prozess, der fremde Dateien liest, lässt sich nicht starten: {error_strerror}</translation>
        </message>
        <message>
            <source>no sentence</source>
            <translation type="unfinished">kein Satz</translation>
        </message>
        <message>
            <source>a template without its values</source>
            <translation type="unfinished">eine Vorlage ohne ihre Werte</translation>
        </message>
        <message>
            <source>a sentence without end</source>
            <translation type="unfinished">ein Satz ohne Ende</translation>
        </message>
        <message>
            <source>a number without end</source>
            <translation type="unfinished">eine Zahl ohne Ende</translation>
        </message>
        <message>
            <source>no template</source>
            <translation type="unfinished">keine Vorlage</translation>
        </message>
        <message>
            <source>a template that does more than name its values</source>
            <translation type="unfinished">eine Vorlage, die mehr tut, als ihre Werte zu nennen</translation>
        </message>
        <message>
            <source>{ready} of {count} files</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{path}: {fault} (decoder {decoder}); leave it out</source>
            <translation type="unfinished">{path}: {fault} (Decoder {decoder}); lassen Sie die Datei weg</translation>
        </message>
        <message>
            <source>{path}: {fault}</source>
            <translation type="unfinished">{path}: {fault}</translation>
        </message>
        <message>
            <source>{where}: {msg}</source>
            <translation type="unfinished">{where}: {msg}</translation>
        </message>
        <message>
            <source>{type_name} where an array is wanted</source>
            <translation type="unfinished">{type_name}, wo ein Array verlangt ist</translation>
        </message>
        <message>
            <source>an array of {value_dtype}, not of {dtype}</source>
            <translation type="unfinished">ein Array vom Typ {value_dtype}, nicht {dtype}</translation>
        </message>
        <message>
            <source>geometry: {name} is {length} m; a positive length is needed</source>
            <translation type="unfinished">Geometrie: {name} ist {length} m; nötig ist eine positive Länge</translation>
        </message>
        <message>
            <source>geometry: the fulcrum stands at z = {fulcrum} m; it must be above the links (z &gt; 0)</source>
            <translation type="unfinished">Geometrie: Der Drehpunkt steht bei z = {fulcrum} m; er muss über den Gliedern liegen (z &gt; 0)</translation>
        </message>
        <message>
            <source>{name} has shape {array_shape}; (2,) is needed</source>
            <translation type="unfinished">{name} hat die Form {array_shape}; nötig ist (2,)</translation>
        </message>
        <message>
            <source>device {profile_name} is a {profile_kind}, no pantograph</source>
            <translation type="unfinished">das Gerät {profile_name} ist ein {profile_kind}, kein Pantograph</translation>
        </message>
        <message>
            <source>fulcrum stands at y = {y:g} m; it must be in front of the motors, y &gt; 0</source>
            <translation type="unfinished">fulcrum steht bei y = {y:g} m; es muss vor den Motoren liegen, y &gt; 0</translation>
        </message>
        <message>
            <source>fulcrum stands over a point {away:.4g} m from the {name} motor axis; proximal and distal reach from {low:.4g} to {high:.4g} m</source>
            <translation type="unfinished">fulcrum steht über einem Punkt {away:.4g} m von der Motorachse ({name}); proximal und distal reichen von {low:.4g} bis {high:.4g} m</translation>
        </message>
        <message>
            <source>fulcrum ({x:g}, {y:g}) m lies behind the elbows; with elbows outwards the links meet on the far side of them (greater y)</source>
            <translation type="unfinished">fulcrum ({x:g}, {y:g}) m liegt hinter den Ellbogen; mit nach außen gebogenen Ellbogen treffen sich die Glieder auf deren anderer Seite (größeres y)</translation>
        </message>
        <message>
            <source>needle_length {needle_length:g} m must be greater than the lever below the fulcrum, {height:g} m, or nothing is left above it to hold</source>
            <translation type="unfinished">needle_length {needle_length:g} m muss größer sein als der Hebel unter dem Drehpunkt, {height:g} m, sonst bleibt darüber nichts zum Halten</translation>
        </message>
        <message>
            <source>workspace.tilt_limit_deg of joint {name!r} is {tilt:g}: there the tool would be {away:.3g} m from under the fulcrum, and the links reach {reach:.3g} m at most; give at most {degrees:.1f}</source>
            <translation type="unfinished">workspace.tilt_limit_deg des Gelenks {name!r} ist {tilt:g}: Dort wäre das Werkzeug {away:.3g} m von der Stelle unter dem Drehpunkt entfernt, und die Glieder reichen höchstens {reach:.3g} m; geben Sie höchstens {degrees:.1f} an</translation>
        </message>
        <message>
            <source>device {profile_name} is of kind {profile_kind}; this is about devices of kind pantograph alone</source>
            <translation type="unfinished">das Gerät {profile_name} ist von der Art {profile_kind}; hier geht es nur um Geräte der Art pantograph</translation>
        </message>
        <message>
            <source>no grip: L_out = {needle_l_out} m; a positive length is needed</source>
            <translation type="unfinished">kein Griff: L_out = {needle_l_out} m; nötig ist eine positive Länge</translation>
        </message>
        <message>
            <source>degenerate: the needle direction {needle_axis} does not point down through the plane of the links</source>
            <translation type="unfinished">entartet: Die Nadelrichtung {needle_axis} zeigt nicht nach unten durch die Ebene der Glieder</translation>
        </message>
        <message>
            <source>jacobian has shape {array_shape}; (2, 2) is needed</source>
            <translation type="unfinished">die Jacobi-Matrix hat die Form {array_shape}; nötig ist (2, 2)</translation>
        </message>
        <message>
            <source>force has shape {array_shape}; (3,) is needed</source>
            <translation type="unfinished">die Kraft hat die Form {array_shape}; nötig ist (3,)</translation>
        </message>
        <message>
            <source>P3 = {needle_p3} m: this working mode does not close there in assembly {assembly}, which puts P3 at {reached} m</source>
            <translation type="unfinished">P3 = {needle_p3} m: Diese Arbeitsstellung schließt dort im Aufbau {assembly} nicht, der P3 auf {reached} m legt</translation>
        </message>
        <message>
            <source>singular ({kind}): joint rates at P3 = {needle_p3} m</source>
            <translation type="unfinished">singulär ({kind}): Gelenkgeschwindigkeiten bei P3 = {needle_p3} m</translation>
        </message>
        <message>
            <source>no grip: L_out = {outside} m at L_in = {l_in} m; the needle of {length} m must stand out of the fulcrum (L_out &gt; 0)</source>
            <translation type="unfinished">kein Griff: L_out = {outside} m bei L_in = {l_in} m; die Nadel von {length} m muss aus dem Drehpunkt herausragen (L_out &gt; 0)</translation>
        </message>
        <message>
            <source>l_out = {l_out} m does not fit mode {mode!r}: mode 'measured' needs l_out, mode 'printed' computes it</source>
            <translation type="unfinished">l_out = {l_out} m passt nicht zum Modus {mode!r}: Der Modus „measured“ braucht l_out, der Modus „printed“ berechnet es</translation>
        </message>
        <message>
            <source>hub has shape {point_shape}; (3,) is needed</source>
            <translation type="unfinished">der Ansatz hat die Form {point_shape}; nötig ist (3,)</translation>
        </message>
        <message>
            <source>workspace.depth_max {deepest:g} m must be below geometry.needle_length {length:g} m: the hub stays outside the fulcrum</source>
            <translation type="unfinished">workspace.depth_max {deepest:g} m muss unter geometry.needle_length {length:g} m liegen: Der Ansatz bleibt außerhalb des Drehpunkts</translation>
        </message>
        <message>
            <source>inertia.needle_centre {inertia_needle_centre:g} m must lie on the needle of geometry.needle_length {length:g} m</source>
            <translation type="unfinished">inertia.needle_centre {inertia_needle_centre:g} m muss auf der Nadel mit geometry.needle_length {length:g} m liegen</translation>
        </message>
        <message>
            <source>device {name}: machine {kind!r} cannot be used: {fault}</source>
            <translation type="unfinished">Gerät {name}: Die Maschine {kind!r} ist nicht verwendbar: {fault}</translation>
        </message>
        <message>
            <source>device {name}: no joint {joint!r}; valid names: {names}</source>
            <translation type="unfinished">Gerät {name}: Es gibt kein Gelenk {joint!r}; gültige Namen: {names}</translation>
        </message>
        <message>
            <source>device {name}: a needle of {length:g} m; it holds needles longer than {least:g} m and shorter than {longest_needle:g} m</source>
            <translation type="unfinished">Gerät {name}: eine Nadel von {length:g} m; es hält Nadeln, die länger als {least:g} m und kürzer als {longest_needle:g} m sind</translation>
        </message>
        <message>
            <source>{origin}: kind: there is no machine of kind {kind!r}; valid kinds: {kinds}</source>
            <translation type="unfinished">{origin}: kind: Es gibt keine Maschine der Art {kind!r}; gültige Arten: {kinds}</translation>
        </message>
        <message>
            <source>{origin}: machine {kind!r}: {module_file} has no PROFILE</source>
            <translation type="unfinished">{origin}: Maschine {kind!r}: {module_file} hat kein PROFILE</translation>
        </message>
        <message>
            <source>{origin}: machine {kind!r} cannot be used: {fault}</source>
            <translation type="unfinished">{origin}: Die Maschine {kind!r} ist nicht verwendbar: {fault}</translation>
        </message>
        <message>
            <source>no device profile {wanted!r}; valid names: {profile_names}, or the path of a .yaml file</source>
            <translation type="unfinished">es gibt kein Geräteprofil {wanted!r}; gültige Namen: {profile_names}, oder der Pfad einer .yaml-Datei</translation>
        </message>
        <message>
            <source>no provenance for {missing}</source>
            <translation type="unfinished">keine Herkunft (provenance) für {missing}</translation>
        </message>
        <message>
            <source>provenance of {unknown}, which the section does not have</source>
            <translation type="unfinished">Herkunft (provenance) von {unknown}, das der Abschnitt nicht hat</translation>
        </message>
        <message>
            <source>joint {joint!r} is not one of {tilt_limit_deg}</source>
            <translation type="unfinished">das Gelenk {joint!r} ist keines von {tilt_limit_deg}</translation>
        </message>
        <message>
            <source>depth_min {least_depth} must be below depth_max {largest_depth}</source>
            <translation type="unfinished">depth_min {least_depth} muss unter depth_max {largest_depth} liegen</translation>
        </message>
        <message>
            <source>no joint angles point the needle along {axis} ({branches})</source>
            <translation type="unfinished">keine Gelenkwinkel richten die Nadel entlang {axis} aus ({branches})</translation>
        </message>
        <message>
            <source>needle direction {direction} does not point down</source>
            <translation type="unfinished">die Nadelrichtung {direction} zeigt nicht nach unten</translation>
        </message>
        <message>
            <source>{status}: {cause}</source>
            <translation type="unfinished">{status}: {cause}</translation>
        </message>
        <message>
            <source>not finite: β = {b} rad, τ = {asked} N·m, stiffness {wanted}</source>
            <translation type="unfinished">nicht endlich: β = {b} rad, τ = {asked} N·m, Steifigkeit {wanted}</translation>
        </message>
        <message>
            <source>stiffness is {wanted} N·m/rad; ask for more than 0, or for none</source>
            <translation type="unfinished">die Steifigkeit ist {wanted} N·m/rad; verlangen Sie mehr als 0, oder keine</translation>
        </message>
        <message>
            <source>degenerate: L_out = {l_out} m; a hub stands outside the centre</source>
            <translation type="unfinished">entartet: L_out = {l_out} m; ein Ansatz steht außerhalb des Zentrums</translation>
        </message>
        <message>
            <source>singular: stiffness of the guide at β = {beta} rad</source>
            <translation type="unfinished">singulär: Steifigkeit der Führung bei β = {beta} rad</translation>
        </message>
        <message>
            <source>Jacobian has {entries} entries; 6 are needed</source>
            <translation type="unfinished">Einträge der Jacobi-Matrix: {entries}; nötig sind 6</translation>
        </message>
        <message>
            <source>geometry: {name} is {degrees:.6g}°; a base joint stands within ±89° of its horizontal axis</source>
            <translation type="unfinished">Geometrie: {name} ist {degrees:.6g}°; ein Basisgelenk steht innerhalb von ±89° seiner waagrechten Achse</translation>
        </message>
        <message>
            <source>geometry: reading is {reading!r}; there are {joint_reading}</source>
            <translation type="unfinished">Geometrie: reading ist {reading!r}; möglich sind {joint_reading}</translation>
        </message>
        <message>
            <source>geometry: the base joints lie {degrees:.3g}° apart as seen from the remote centre; they span no sphere within 2° of 0° or 180°: lower a tilt</source>
            <translation type="unfinished">Geometrie: Die Basisgelenke liegen vom Drehzentrum aus gesehen {degrees:.3g}° auseinander; innerhalb von 2° um 0° oder 180° spannen sie keine Kugel auf: Verringern Sie eine Neigung</translation>
        </message>
        <message>
            <source>geometry: the bars reach {first_reach_deg:.4g}° and {second_reach_deg:.4g}°, the base joints are {apart_deg:.4g}° apart: no pose closes both pantographs; lengthen f1 or f2</source>
            <translation type="unfinished">Geometrie: Die Stäbe reichen {first_reach_deg:.4g}° und {second_reach_deg:.4g}° weit, die Basisgelenke liegen {apart_deg:.4g}° auseinander: Keine Stellung schließt beide Pantographen; verlängern Sie f1 oder f2</translation>
        </message>
        <message>
            <source>cables: {name} is {quantity}; give a number</source>
            <translation type="unfinished">Seile: {name} ist {quantity}; geben Sie eine Zahl an</translation>
        </message>
        <message>
            <source>cables: stiffness {stiffness} N/m, stiffening {stiffening} 1/m; the first must be positive, the second 0 or more</source>
            <translation type="unfinished">Seile: Steifigkeit {stiffness} N/m, Versteifung {stiffening} 1/m; die erste muss positiv sein, die zweite 0 oder größer</translation>
        </message>
        <message>
            <source>cables: tensions from {least} to {most} N; a cable pulls, so the least is 0 or more, and below the most</source>
            <translation type="unfinished">Seile: Spannungen von {least} bis {most} N; ein Seil zieht, daher ist die kleinste 0 oder größer und liegt unter der größten</translation>
        </message>
        <message>
            <source>bars: {name} is {quantity}; a positive number is needed</source>
            <translation type="unfinished">Stäbe: {name} ist {quantity}; nötig ist eine positive Zahl</translation>
        </message>
        <message>
            <source>masses: {name} is {mass}; a number from 0 on is needed</source>
            <translation type="unfinished">Massen: {name} ist {mass}; nötig ist eine Zahl ab 0</translation>
        </message>
        <message>
            <source>{name} has shape {array_shape}; ({count},) is needed</source>
            <translation type="unfinished">{name} hat die Form {array_shape}; nötig ist ({count},)</translation>
        </message>
        <message>
            <source>unreachable: direction t = ({x}, {y}, {z}); the nearest within reach is {near}, {away:.3g}° away</source>
            <translation type="unfinished">unerreichbar: Richtung t = ({x}, {y}, {z}); die nächste erreichbare ist {near}, {away:.3g}° entfernt</translation>
        </message>
        <message>
            <source>degenerate: t = {array} has no direction</source>
            <translation type="unfinished">entartet: t = {array} hat keine Richtung</translation>
        </message>
        <message>
            <source>unreachable: a margin of {degrees:.4g}° leaves nothing of the workspace; ask for less</source>
            <translation type="unfinished">unerreichbar: Ein Abstand von {degrees:.4g}° lässt vom Arbeitsraum nichts übrig; verlangen Sie weniger</translation>
        </message>
        <message>
            <source>degenerate: (η, μ) = ({eta}, {mu}) rad; η within ±π/2 and μ between 0 and π point up</source>
            <translation type="unfinished">entartet: (η, μ) = ({eta}, {mu}) rad; η innerhalb von ±π/2 und μ zwischen 0 und π zeigen nach oben</translation>
        </message>
        <message>
            <source>encoder: {steps} steps per turn; a positive number is needed</source>
            <translation type="unfinished">Encoder: {steps} Schritte je Umdrehung; nötig ist eine positive Zahl</translation>
        </message>
        <message>
            <source>device {profile_name} is a {profile_kind}, no tensegrity</source>
            <translation type="unfinished">das Gerät {profile_name} ist ein {profile_kind}, keine Tensegrity</translation>
        </message>
        <message>
            <source>beta has shape {b_shape}; (2,) is needed</source>
            <translation type="unfinished">beta hat die Form {b_shape}; nötig ist (2,)</translation>
        </message>
        <message>
            <source>unreachable: no direction for β = {b} rad after {evaluations} evaluations</source>
            <translation type="unfinished">unerreichbar: keine Richtung für β = {b} rad nach {evaluations} Auswertungen</translation>
        </message>
        <message>
            <source>degenerate: T stands on A{base_number}; its rhombus has no plane there, turn the guide away</source>
            <translation type="unfinished">entartet: T steht auf A{base_number}; dort hat sein Rhombus keine Ebene, drehen Sie die Führung weg</translation>
        </message>
        <message>
            <source>not finite: spheres at {c} with radii {r}</source>
            <translation type="unfinished">nicht endlich: Kugeln bei {c} mit den Radien {r}</translation>
        </message>
        <message>
            <source>degenerate: the centres of the spheres lie in one line: {c}</source>
            <translation type="unfinished">entartet: Die Mittelpunkte der Kugeln liegen auf einer Geraden: {c}</translation>
        </message>
        <message>
            <source>unreachable: spheres with radii {r} m at {c} m have no point in common</source>
            <translation type="unfinished">unerreichbar: Kugeln mit den Radien {r} m bei {c} m haben keinen gemeinsamen Punkt</translation>
        </message>
        <message>
            <source>tensions must rise from least ({least:g} N) over holding ({holding:g} N) to most ({most:g} N)</source>
            <translation type="unfinished">die Spannungen müssen ansteigen, von least ({least:g} N) über holding ({holding:g} N) zu most ({most:g} N)</translation>
        </message>
        <message>
            <source>the plan has no {missing} yet: click it in one of the views</source>
            <translation type="unfinished">dem Plan fehlt noch ein Punkt ({missing}): Klicken Sie ihn in einer der Ansichten an</translation>
        </message>
        <message>
            <source>a region needs an extent both ways: drag from corner to corner</source>
            <translation type="unfinished">ein Bereich braucht Ausdehnung in beiden Richtungen: Ziehen Sie von Ecke zu Ecke</translation>
        </message>
        <message>
            <source>the two points are {length:.2f} mm apart; choose points at least {shortest_mm:g} mm apart for a plane through them</source>
            <translation type="unfinished">die beiden Punkte liegen {length:.2f} mm auseinander; wählen Sie für eine Ebene durch sie Punkte mit mindestens {shortest_mm:g} mm Abstand</translation>
        </message>
        <message>
            <source>no path of {length_mm:g} mm from the anterior skin stays in the body of this CT; place entry and target yourself</source>
            <translation type="unfinished">kein Pfad von {length_mm:g} mm ab der vorderen Haut bleibt im Körper dieses CT; setzen Sie Einstichpunkt und Ziel selbst</translation>
        </message>
        <message>
            <source>scoring paths</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>paths scored</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>rotation_deg ({x:g}, {y:g}, {z:g}) must be within ±360°</source>
            <translation type="unfinished">rotation_deg ({x:g}, {y:g}, {z:g}) muss innerhalb von ±360° liegen</translation>
        </message>
        <message>
            <source>entry {entry} and target {target} are {length_mm:.3g} mm apart; a path needs at least {shortest_mm:g} mm: move one of the two points</source>
            <translation type="unfinished">Einstichpunkt {entry} und Ziel {target} liegen {length_mm:.3g} mm auseinander; ein Pfad braucht mindestens {shortest_mm:g} mm: Verschieben Sie einen der beiden Punkte</translation>
        </message>
        <message>
            <source>target {target} lies outside the body: click inside the patient</source>
            <translation type="unfinished">das Ziel {target} liegt außerhalb des Körpers: Klicken Sie in den Patienten</translation>
        </message>
        <message>
            <source>{name} {point!r} is not a point of three numbers</source>
            <translation type="unfinished">{name} {point!r} ist kein Punkt aus drei Zahlen</translation>
        </message>
        <message>
            <source>{name} has shape {array_shape}; three coordinates (3,) are needed</source>
            <translation type="unfinished">{name} hat die Form {array_shape}; nötig sind drei Koordinaten (3,)</translation>
        </message>
        <message>
            <source>{name} {array} must be finite and within ±{largest_mm:g} mm</source>
            <translation type="unfinished">{name} {array} muss endlich sein und innerhalb von ±{largest_mm:g} mm liegen</translation>
        </message>
        <message>
            <source>leave the patient as is</source>
            <translation type="unfinished">den Patienten so lassen, wie er liegt</translation>
        </message>
        <message>
            <source>turn the patient {angle_deg:.1f}° about {axis_words}</source>
            <translation type="unfinished">drehen Sie den Patienten um {angle_deg:.1f}° (Achse: {axis_words})</translation>
        </message>
        <message>
            <source>the axis (L {left:.2f}, P {posterior:.2f}, S {superior:.2f}) through the entry</source>
            <translation type="unfinished">die Achse (L {left:.2f}, P {posterior:.2f}, S {superior:.2f}) durch den Einstichpunkt</translation>
        </message>
        <message>
            <source>lay the patient {lying} (tilt {tilt:.0f}°)</source>
            <translation type="unfinished">lagern Sie den Patienten {lying} (Neigung {tilt:.0f}°)</translation>
        </message>
        <message>
            <source>reachable: tilt {tilt_deg:.1f}°, depth {depth_mm:.1f} mm</source>
            <translation type="unfinished">erreichbar: Neigung {tilt_deg:.1f}°, Tiefe {depth_mm:.1f} mm</translation>
        </message>
        <message>
            <source>out of reach: {reasons}</source>
            <translation type="unfinished">außer Reichweite: {reasons}</translation>
        </message>
        <message>
            <source>out of reach: {reasons}. Remedy: {remedy}</source>
            <translation type="unfinished">außer Reichweite: {reasons}. Abhilfe: {remedy}</translation>
        </message>
        <message>
            <source>upward (tilt {tilt:.1f}° of 180°)</source>
            <translation type="unfinished">aufwärts (Neigung {tilt:.1f}° von 180°)</translation>
        </message>
        <message>
            <source>the path runs {way}; the needle enters from above, at most {limit:g}° from vertical</source>
            <translation type="unfinished">der Pfad verläuft {way}; die Nadel sticht von oben ein, höchstens {limit:g}° von der Senkrechten</translation>
        </message>
        <message>
            <source>tool point ({x:.1f}, {y:.1f}) mm lies outside the robot's workspace</source>
            <translation type="unfinished">der Werkzeugpunkt ({x:.1f}, {y:.1f}) mm liegt außerhalb des Arbeitsraums des Roboters</translation>
        </message>
        <message>
            <source>depth {depth_mm:.1f} mm exceeds {limits_depth_limit_mm:g} mm; no rotation shortens a path: choose an entry closer to the target</source>
            <translation type="unfinished">die Tiefe {depth_mm:.1f} mm überschreitet {limits_depth_limit_mm:g} mm; keine Drehung verkürzt einen Pfad: Wählen Sie einen Einstichpunkt näher am Ziel</translation>
        </message>
        <message>
            <source>a shift that all share: {sqrt_mm:.2f} mm by the plate</source>
            <translation type="unfinished">eine allen gemeinsame Verschiebung: {sqrt_mm:.2f} mm laut Platte</translation>
        </message>
        <message>
            <source>a shift that all share is not in it</source>
            <translation type="unfinished">eine allen gemeinsame Verschiebung ist nicht enthalten</translation>
        </message>
        <message>
            <source>errors of each point as stated</source>
            <translation type="unfinished">Fehler jedes Punkts wie angegeben</translation>
        </message>
        <message>
            <source>, which the residuals exceed</source>
            <translation type="unfinished">, die von den Restfehlern übertroffen werden</translation>
        </message>
        <message>
            <source>shape of the errors by the residuals</source>
            <translation type="unfinished">Form der Fehler nach den Restfehlern</translation>
        </message>
        <message>
            <source>holds for errors that are as large in every direction</source>
            <translation type="unfinished">gilt für Fehler, die in jeder Richtung gleich groß sind</translation>
        </message>
        <message>
            <source>the points do not fit the plate, so nothing can be said of the target; see the residuals, touch the named fiducials again</source>
            <translation type="unfinished">die Punkte passen nicht zur Platte, daher lässt sich über das Ziel nichts sagen; sehen Sie sich die Restfehler an und berühren Sie die genannten Referenzmarken noch einmal</translation>
        </message>
        <message>
            <source>plate {plate_name} has no known place in the robot's frame and no beads were picked: the touches have nothing to agree with; give `place`, or pick the beads in the CT</source>
            <translation type="unfinished">die Platte {plate_name} hat keinen bekannten Ort im Koordinatensystem des Roboters, und es wurden keine Kugeln gewählt: Die Berührungen haben nichts, womit sie übereinstimmen könnten; geben Sie `place` an, oder wählen Sie die Kugeln im CT</translation>
        </message>
        <message>
            <source>touch {lacking} more {fiducials}</source>
            <translation type="unfinished">noch zu berühren: {lacking} {fiducials}</translation>
        </message>
        <message>
            <source>pick {lacking} more {beads} in the CT, or none</source>
            <translation type="unfinished">noch im CT zu wählen: {lacking} {beads}, oder keine</translation>
        </message>
        <message>
            <source>two fiducials have the same name: {names}</source>
            <translation type="unfinished">zwei Referenzmarken haben denselben Namen: {names}</translation>
        </message>
        <message>
            <source>plate {plate_name} has no fiducial {fiducial_name!r}; it has {names}</source>
            <translation type="unfinished">die Platte {plate_name} hat keine Referenzmarke {fiducial_name!r}; vorhanden: {names}</translation>
        </message>
        <message>
            <source>fiducial {name!r} is given twice; keep one of them</source>
            <translation type="unfinished">die Referenzmarke {name!r} ist zweimal angegeben; behalten Sie eine davon</translation>
        </message>
        <message>
            <source>no fiducial plate {wanted!r}; valid names: {plate_names}, or the path of a .yaml file</source>
            <translation type="unfinished">es gibt keine Platte mit Referenzmarken {wanted!r}; gültige Namen: {plate_names}, oder der Pfad einer .yaml-Datei</translation>
        </message>
        <message>
            <source>the point {point} lies outside the CT: click a slice</source>
            <translation type="unfinished">der Punkt {point} liegt außerhalb des CT: Klicken Sie auf eine Schicht</translation>
        </message>
        <message>
            <source>no bead within {search:.1f} mm of {point}: the brightest voxel is {contrast:.0f} HU above its surroundings, {least_contrast:.0f} are needed</source>
            <translation type="unfinished">keine Kugel innerhalb von {search:.1f} mm um {point}: Das hellste Voxel liegt {contrast:.0f} HU über seiner Umgebung, nötig sind {least_contrast:.0f}</translation>
        </message>
        <message>
            <source>the bead at {centre} reaches the edge of the CT: use another one</source>
            <translation type="unfinished">die Kugel bei {centre} reicht bis an den Rand des CT: Nehmen Sie eine andere</translation>
        </message>
        <message>
            <source>what is bright at {point} is {measured_mm:.1f} mm across, a bead is {bead_mm:.1f} mm (at most {largest_mm:.1f} mm in this CT): bone, or two beads; click on a bead</source>
            <translation type="unfinished">was bei {point} hell ist, misst {measured_mm:.1f} mm, eine Kugel {bead_mm:.1f} mm (in diesem CT höchstens {largest_mm:.1f} mm): Knochen, oder zwei Kugeln; klicken Sie auf eine Kugel</translation>
        </message>
        <message>
            <source>{names} names for {points} points</source>
            <translation type="unfinished">Namen: {names}, Punkte: {points}</translation>
        </message>
        <message>
            <source>{path} holds no points</source>
            <translation type="unfinished">{path} enthält keine Punkte</translation>
        </message>
        <message>
            <source>{path} is no text; give a CSV file with the header name,x_mm,y_mm,z_mm, or YAML</source>
            <translation type="unfinished">{path} ist kein Text; geben Sie eine CSV-Datei mit der Kopfzeile name,x_mm,y_mm,z_mm an, oder YAML</translation>
        </message>
        <message>
            <source>{path}: column {column} is missing; the first line must be name,x_mm,y_mm,z_mm and may add sd_mm</source>
            <translation type="unfinished">{path}: Die Spalte {column} fehlt; die erste Zeile muss name,x_mm,y_mm,z_mm sein und darf sd_mm hinzufügen</translation>
        </message>
        <message>
            <source>{path}, {where}: sd_mm {deviation:g} is negative</source>
            <translation type="unfinished">{path}, {where}: sd_mm {deviation:g} ist negativ</translation>
        </message>
        <message>
            <source>{path}: a mapping of names to [x, y, z] in mm is needed</source>
            <translation type="unfinished">{path}: Nötig ist eine Zuordnung von Namen zu [x, y, z] in mm</translation>
        </message>
        <message>
            <source>{path}, {name}: [x, y, z] in mm is needed, got {entry!r}</source>
            <translation type="unfinished">{path}, {name}: Nötig ist [x, y, z] in mm, nicht {entry!r}</translation>
        </message>
        <message>
            <source>{path}, {where}: {entry!r} is not a number</source>
            <translation type="unfinished">{path}, {where}: {entry!r} ist keine Zahl</translation>
        </message>
        <message>
            <source>{path}, {where}: {entry!r} is not finite</source>
            <translation type="unfinished">{path}, {where}: {entry!r} ist nicht endlich</translation>
        </message>
        <message>
            <source>format {format} {version} is not {known_format} 1</source>
            <translation type="unfinished">Format {format} {version} ist nicht {known_format} 1</translation>
        </message>
        <message>
            <source>{reference_points} reference points and {measured_points} measured ones: give each fiducial once in both</source>
            <translation type="unfinished">Punkte der Vorlage: {reference_points}, gemessene: {measured_points}; geben Sie jede Referenzmarke in beiden einmal an</translation>
        </message>
        <message>
            <source>two rotations fit these points equally well: the measured ones look like the mirror image of the reference; check the order of the points and the signs of the coordinates</source>
            <translation type="unfinished">zwei Drehungen passen gleich gut zu diesen Punkten: Die gemessenen sehen aus wie das Spiegelbild der Vorlage; prüfen Sie die Reihenfolge der Punkte und die Vorzeichen der Koordinaten</translation>
        </message>
        <message>
            <source>{name} points are not a list of three numbers each</source>
            <translation type="unfinished">Punkte ({name}): keine Liste mit je drei Zahlen</translation>
        </message>
        <message>
            <source>{name} points have shape {array_shape}; (n, 3) is needed</source>
            <translation type="unfinished">Punkte ({name}): Die Form ist {array_shape}; nötig ist (n, 3)</translation>
        </message>
        <message>
            <source>{name} point {i} is {point} m: finite numbers within ±{largest:g} m are needed (millimetres where metres are meant?)</source>
            <translation type="unfinished">Punkt {i} ({name}) ist {point} m: Nötig sind endliche Zahlen innerhalb von ±{largest:g} m (Millimeter statt Meter?)</translation>
        </message>
        <message>
            <source>{points_given} {name} {points}: a registration needs at least {fewest}, and {fewest_to_check} to find a wrong one</source>
            <translation type="unfinished">{points_given} {points} ({name}): Eine Registrierung braucht mindestens {fewest}, und {fewest_to_check}, um einen falschen zu finden</translation>
        </message>
        <message>
            <source>the {name} points lie within {extent_mm:.2f} mm of each other: they are one point; touch fiducials that are far apart</source>
            <translation type="unfinished">die Punkte ({name}) liegen innerhalb von {extent_mm:.2f} mm: Sie sind ein Punkt; berühren Sie Referenzmarken, die weit auseinanderliegen</translation>
        </message>
        <message>
            <source>the {name} points lie on one line within {width_mm:.2f} mm: the turn about it stays unknown; add a fiducial beside the line</source>
            <translation type="unfinished">die Punkte ({name}) liegen bis auf {width_mm:.2f} mm auf einer Geraden: Die Drehung um sie bleibt unbekannt; nehmen Sie eine Referenzmarke neben der Geraden dazu</translation>
        </message>
        <message>
            <source>weights {array}: {count} positive numbers within a factor of 1e6 are needed</source>
            <translation type="unfinished">Gewichte {array}: Nötig sind {count} positive Zahlen, die höchstens um den Faktor 1e6 auseinanderliegen</translation>
        </message>
        <message>
            <source>screen and needle agree within ± {mm} mm (95 %)</source>
            <translation type="unfinished">Bildschirm und Nadel stimmen auf ± {mm} mm überein (95 %)</translation>
        </message>
        <message>
            <source>TRE at the target: {expected_mm} mm RMS expected, at least 95 % within {within_95_mm} mm ({check_world_condition})</source>
            <translation type="unfinished">TRE am Ziel: {expected_mm} mm RMS erwartet, mindestens 95 % innerhalb von {within_95_mm} mm ({check_world_condition})</translation>
        </message>
        <message>
            <source>{title}: {fiducials} fiducials, FRE {fre_mm} mm (fit of the points, not accuracy)</source>
            <translation type="unfinished">{title}: Referenzmarken: {fiducials}, FRE {fre_mm} mm (Passung der Punkte, nicht Genauigkeit)</translation>
        </message>
        <message>
            <source>{title}: FLE {fle_mm} mm, between {lower_mm} and {upper_mm} mm with 95 % ({error_freedom} degrees of freedom)</source>
            <translation type="unfinished">{title}: FLE {fle_mm} mm, mit 95 % zwischen {lower_mm} und {upper_mm} mm (Freiheitsgrade: {error_freedom})</translation>
        </message>
        <message>
            <source>fiducials {moved} were {verb} in another order: exchanged, they fit within {mm} mm; name them again</source>
            <translation type="unfinished">Referenzmarken in anderer Reihenfolge ({verb}): {moved}; vertauscht passen sie auf {mm} mm; benennen Sie sie neu</translation>
        </message>
        <message>
            <source>fiducial {name} lies {distance_mm} mm from where the others put it (they agree within {agreement_mm} mm): do {name} again</source>
            <translation type="unfinished">die Referenzmarke {name} liegt {distance_mm} mm von der Stelle, an die die anderen sie setzen (diese stimmen auf {agreement_mm} mm überein): Nehmen Sie {name} noch einmal auf</translation>
        </message>
        <message>
            <source>the {verb} points do not fit the plate: the largest residual is {residual_mm} mm at {name}, the limit is {limit_mm} mm; is it this plate? do all points again</source>
            <translation type="unfinished">die Punkte ({verb}) passen nicht zur Platte: Der größte Restfehler ist {residual_mm} mm bei {name}, die Grenze {limit_mm} mm; ist es diese Platte? Nehmen Sie alle Punkte noch einmal auf</translation>
        </message>
        <message>
            <source>the {verb} points scatter more than careful work explains (FLE {mm} mm); the figure below allows for it</source>
            <translation type="unfinished">die Punkte ({verb}) streuen mehr, als sorgfältige Arbeit erklärt (FLE {mm} mm); die Zahl unten berücksichtigt es</translation>
        </message>
        <message>
            <source>lengths between the {verb} points are {off:.1%} too {direction} (± {part_scale_sd:.1%})</source>
            <translation type="unfinished">Längen zwischen den Punkten ({verb}) sind um {off:.1%} zu {direction} (± {part_scale_sd:.1%})</translation>
        </message>
        <message>
            <source>{finding}: the CT's spacing is wrong, or this is another plate</source>
            <translation type="unfinished">{finding}: Der Pixel- oder Schichtabstand des CT ist falsch, oder dies ist eine andere Platte</translation>
        </message>
        <message>
            <source>{finding}: the cameras were calibrated with a board of another size than said. Measure its line of 100 mm and its squares, calibrate again; or this is another plate</source>
            <translation type="unfinished">{finding}: Die Kameras wurden mit einer Tafel kalibriert, deren Größe nicht stimmt. Messen Sie ihre 100-mm-Linie und ihre Quadrate nach und kalibrieren Sie neu; oder es ist eine andere Platte</translation>
        </message>
        <message>
            <source>one of them has no score</source>
            <translation type="unfinished">einer davon hat keine Bewertung</translation>
        </message>
        <message>
            <source>the exercise says something else under the same version</source>
            <translation type="unfinished">die Übung sagt unter derselben Version etwas anderes</translation>
        </message>
        <message>
            <source>what robot it was is not known of one of them</source>
            <translation type="unfinished">bei einem davon ist nicht bekannt, welcher Roboter es war</translation>
        </message>
        <message>
            <source>what the assistance was is not known of one of them</source>
            <translation type="unfinished">bei einem davon ist nicht bekannt, wie die Unterstützung eingestellt war</translation>
        </message>
        <message>
            <source>{entry!r} is no number</source>
            <translation type="unfinished">{entry!r} ist keine Zahl</translation>
        </message>
        <message>
            <source>it ends the program ({fault})</source>
            <translation type="unfinished">sie beendet das Programm ({fault})</translation>
        </message>
        <message>
            <source>{tissue} at {entered_mm} mm: a number is not finite</source>
            <translation type="unfinished">{tissue} bei {entered_mm} mm: Eine Zahl ist nicht endlich</translation>
        </message>
        <message>
            <source>{kind!r} is no kind of tissue</source>
            <translation type="unfinished">{kind!r} ist keine Gewebeart</translation>
        </message>
        <message>
            <source>{met}, {force:.1f} N</source>
            <translation type="unfinished">{met}, {force:.1f} N</translation>
        </message>
        <message>
            <source>{depth:.1f} ± {sd:.1f} mm</source>
            <translation type="unfinished">{depth:.1f} ± {sd:.1f} mm</translation>
        </message>
        <message>
            <source>{depth:.1f} mm</source>
            <translation type="unfinished">{depth:.1f} mm</translation>
        </message>
        <message>
            <source>{bone} touched by the shaft at {depth}, {crossed_mm:.1f} mm crossed</source>
            <translation type="unfinished">{bone} vom Schaft berührt bei {depth}, {crossed_mm:.1f} mm durchquert</translation>
        </message>
        <message>
            <source>{bone} touched by the shaft at {depth}</source>
            <translation type="unfinished">{bone} vom Schaft berührt bei {depth}</translation>
        </message>
        <message>
            <source>{bone} touched at {depth}, {crossed_mm:.1f} mm crossed</source>
            <translation type="unfinished">{bone} berührt bei {depth}, {crossed_mm:.1f} mm durchquert</translation>
        </message>
        <message>
            <source>{bone} touched at {depth}</source>
            <translation type="unfinished">{bone} berührt bei {depth}</translation>
        </message>
        <message>
            <source>{tissue} by the shaft at {depth}: grazed</source>
            <translation type="unfinished">{tissue} durch den Schaft bei {depth}: gestreift</translation>
        </message>
        <message>
            <source>{tissue} by the shaft at {depth}: {length_mm:.1f} mm</source>
            <translation type="unfinished">{tissue} durch den Schaft bei {depth}: {length_mm:.1f} mm</translation>
        </message>
        <message>
            <source>{tissue} at {depth}: grazed</source>
            <translation type="unfinished">{tissue} bei {depth}: gestreift</translation>
        </message>
        <message>
            <source>{tissue} at {depth}: {length_mm:.1f} mm</source>
            <translation type="unfinished">{tissue} bei {depth}: {length_mm:.1f} mm</translation>
        </message>
        <message>
            <source>no metric {name!r}; there are {names}</source>
            <translation type="unfinished">es gibt keine Messgröße {name!r}; vorhanden sind {names}</translation>
        </message>
        <message>
            <source>the attempt was never begun</source>
            <translation type="unfinished">der Versuch wurde nie begonnen</translation>
        </message>
        <message>
            <source>the needle or its path runs along the patient's length</source>
            <translation type="unfinished">die Nadel oder ihr Pfad verläuft in Längsrichtung des Patienten</translation>
        </message>
        <message>
            <source>no bone was felt along the needle</source>
            <translation type="unfinished">entlang der Nadel war kein Knochen zu spüren</translation>
        </message>
        <message>
            <source>the attempt never got that far</source>
            <translation type="unfinished">so weit kam der Versuch nicht</translation>
        </message>
        <message>
            <source>the depth of the tip was not measured in the body</source>
            <translation type="unfinished">die Tiefe der Spitze im Körper wurde nicht gemessen</translation>
        </message>
        <message>
            <source>the tip touched a target where it came in</source>
            <translation type="unfinished">die Spitze berührte schon beim Einstich ein Ziel</translation>
        </message>
        <message>
            <source>the force of the guidance was not recorded</source>
            <translation type="unfinished">die Kraft der Führung wurde nicht aufgezeichnet</translation>
        </message>
        <message>
            <source>the tip ended {straight_mm:.2f} mm from where it entered; a ratio needs at least 1 mm</source>
            <translation type="unfinished">die Spitze endete {straight_mm:.2f} mm vom Einstichpunkt entfernt; ein Verhältnis braucht mindestens 1 mm</translation>
        </message>
        <message>
            <source>the lung was not entered</source>
            <translation type="unfinished">die Nadel drang nicht in die Lunge ein</translation>
        </message>
        <message>
            <source>no structure of risk was measured</source>
            <translation type="unfinished">es wurde keine Risikostruktur gemessen</translation>
        </message>
        <message>
            <source>how long the needle was inside was not recorded</source>
            <translation type="unfinished">wie lange die Nadel innerhalb war, wurde nicht aufgezeichnet</translation>
        </message>
        <message>
            <source>whether the force was at its limit was not recorded</source>
            <translation type="unfinished">ob die Kraft an ihrer Grenze war, wurde nicht aufgezeichnet</translation>
        </message>
        <message>
            <source>{statement} ({source})</source>
            <translation type="unfinished">{statement} ({source})</translation>
        </message>
        <message>
            <source>Pleural crossings: {crossed}; aerated lung: {aerated:.0f} mm. In published series {percent:g} % of lung biopsies had a pneumothorax, {drain:g} % a drain.</source>
            <translation type="unfinished">Pleuradurchtritte: {crossed}; belüftete Lunge: {aerated:.0f} mm. In veröffentlichten Serien hatten {percent:g} % der Lungenbiopsien einen Pneumothorax, {drain:g} % eine Drainage.</translation>
        </message>
        <message>
            <source>Pleura punctured {entered} times: more than once, against once, has an odds ratio of {ratio:g}.</source>
            <translation type="unfinished">Pleura {entered}-mal durchstochen: Mehrmals gegenüber einmal hat eine Odds-Ratio von {ratio:g}.</translation>
        </message>
        <message>
            <source>A lesion {deep:g} mm deep or more, against less: odds ratio {ratio:g}.</source>
            <translation type="unfinished">Eine Läsion in {deep:g} mm Tiefe oder mehr, gegenüber weniger: Odds-Ratio {ratio:g}.</translation>
        </message>
        <message>
            <source>Pleura met {angle:.0f}° from straight in: series contradict each other about flat ones; one finds more pneumothorax, one finds none.</source>
            <translation type="unfinished">Pleura {angle:.0f}° vom senkrechten Durchtritt getroffen: Zu flachen Winkeln widersprechen sich die Serien; eine findet mehr Pneumothorax, eine keinen Unterschied.</translation>
        </message>
        <message>
            <source>Not known here: emphysema (odds ratio {emphysema:g}), a fissure ({fissure:g}) or a bulla ({bulla:g}) crossed; needles of 18 G or thicker ({thick:g}).</source>
            <translation type="unfinished">Hier nicht bekannt: Emphysem (Odds-Ratio {emphysema:g}), Durchquerung eines Lappenspalts ({fissure:g}) oder einer Bulla ({bulla:g}); Nadeln von 18 G oder dicker ({thick:g}).</translation>
        </message>
        <message>
            <source>Of lung biopsies {bled:g} % bled into the lung, {more:g} % of a higher grade; {coughed:g} % coughed blood.</source>
            <translation type="unfinished">Von den Lungenbiopsien bluteten {bled:g} % in die Lunge ein, {more:g} % höhergradig; bei {coughed:g} % kam es zu Bluthusten.</translation>
        </message>
        <message>
            <source>Of lung biopsies {least:g} to {most:g} %, by series, had an air embolism.</source>
            <translation type="unfinished">Bei {least:g} bis {most:g} % der Lungenbiopsien, je nach Serie, kam es zu einer Luftembolie.</translation>
        </message>
        <message>
            <source>{vessel} met: no published rate of bleeding for that vessel was found.</source>
            <translation type="unfinished">{vessel} getroffen: Für dieses Gefäß fand sich keine veröffentlichte Blutungsrate.</translation>
        </message>
        <message>
            <source>Of liver biopsies {percent:g} % bled majorly.</source>
            <translation type="unfinished">Bei {percent:g} % der Leberbiopsien kam es zu einer größeren Blutung.</translation>
        </message>
        <message>
            <source>Of kidney biopsies {haematoma:g} % had a haematoma, {transfused:g} % bled so that blood was given.</source>
            <translation type="unfinished">Von den Nierenbiopsien hatten {haematoma:g} % ein Hämatom; bei {transfused:g} % blutete es so, dass transfundiert wurde.</translation>
        </message>
        <message>
            <source>Gut</source>
            <translation type="unfinished">Darm</translation>
        </message>
        <message>
            <source>Heart</source>
            <translation type="unfinished">Herz</translation>
        </message>
        <message>
            <source>{tissue} met: no published odds are known here.</source>
            <translation type="unfinished">{tissue} getroffen: Hier ist kein veröffentlichtes Risiko bekannt.</translation>
        </message>
        <message>
            <source>no error lies within {limit}: give 0 or more</source>
            <translation type="unfinished">innerhalb von {limit} liegt kein Fehler: Geben Sie 0 oder mehr an</translation>
        </message>
        <message>
            <source>a wish of 153 respondents (125 radiologists), nobody's measured hand: </source>
            <translation type="unfinished">ein Wunsch von 153 Befragten (125 davon Radiologen), keine gemessene Hand: </translation>
        </message>
        <message>
            <source>{wish}of published hands {at_least}{shares} came so near</source>
            <translation type="unfinished">{wish}so nah kamen von den veröffentlichten Händen {at_least}{shares}</translation>
        </message>
        <message>
            <source>the tip's path is {length:.2f} m long; paths up to {longest:g} m are compared</source>
            <translation type="unfinished">der Weg der Spitze ist {length:.2f} m lang; verglichen werden Wege bis {longest:g} m</translation>
        </message>
        <message>
            <source>the score has no row {name!r}; it has {names}</source>
            <translation type="unfinished">die Bewertung hat keine Zeile {name!r}; sie hat {names}</translation>
        </message>
        <message>
            <source>format {format!r}; only {known_format} is known</source>
            <translation type="unfinished">Format {format!r}; bekannt ist nur {known_format}</translation>
        </message>
        <message>
            <source>not a stored score ({reason})</source>
            <translation type="unfinished">keine gespeicherte Bewertung ({reason})</translation>
        </message>
        <message>
            <source>the tip was tracked for {row:.0f} % of the insertion; {rules_minimum_tracking:g} % are needed</source>
            <translation type="unfinished">die Spitze wurde während {row:.0f} % der Punktion verfolgt; nötig sind {rules_minimum_tracking:g} %</translation>
        </message>
        <message>
            <source>{row_label} is required and cannot be computed: {row_note}</source>
            <translation type="unfinished">{row_label} ist Pflicht und lässt sich nicht berechnen: {row_note}</translation>
        </message>
        <message>
            <source>it holds {constant}</source>
            <translation type="unfinished">sie enthält {constant}</translation>
        </message>
        <message>
            <source>{closest_mm} mm from {name}, limit {limit_mm} mm, at {time} s, inside for {inside_s} s: all must be finite numbers, limit and time inside not negative</source>
            <translation type="unfinished">{closest_mm} mm von {name}, Grenze {limit_mm} mm, bei {time} s, {inside_s} s lang innerhalb: Alle Zahlen müssen endlich sein, die Grenze und die Zeit innerhalb nicht negativ</translation>
        </message>
        <message>
            <source>no tissue is called {unknown_name!r}; there are {forbiddable}</source>
            <translation type="unfinished">kein Gewebe heißt {unknown_name!r}; vorhanden sind {forbiddable}</translation>
        </message>
        <message>
            <source>a kind of tissue is forbidden twice</source>
            <translation type="unfinished">eine Gewebeart ist zweimal verboten</translation>
        </message>
        <message>
            <source>a control scan at {time} s of dose {dose} mGy·cm: both must be finite numbers, the dose not negative</source>
            <translation type="unfinished">ein Kontrollscan bei {time} s mit Dosis {dose} mGy·cm: Beide Zahlen müssen endlich sein, die Dosis nicht negativ</translation>
        </message>
        <message>
            <source>no metric {name!r}; there are {metrics}</source>
            <translation type="unfinished">es gibt keine Messgröße {name!r}; vorhanden sind {metrics}</translation>
        </message>
        <message>
            <source>metric {name!r} cannot be used: {metrics_fault}</source>
            <translation type="unfinished">die Messgröße {name!r} ist nicht verwendbar: {metrics_fault}</translation>
        </message>
        <message>
            <source>{name}: bands {limits_knots} (expert, good, pass) run against the metric, of which {way} is better</source>
            <translation type="unfinished">{name}: Die Einstufung {limits_knots} (expert, good, pass) läuft der Messgröße entgegen, bei der {way} besser ist</translation>
        </message>
        <message>
            <source>the attempt was aborted: {trajectory_aborted}</source>
            <translation type="unfinished">der Versuch wurde abgebrochen: {trajectory_aborted}</translation>
        </message>
        <message>
            <source>the attempt was never begun: it ended before the needle was out of the skin</source>
            <translation type="unfinished">der Versuch wurde nie begonnen: Er endete, bevor die Nadel aus der Haut war</translation>
        </message>
        <message>
            <source>nothing measured how deep the needle was</source>
            <translation type="unfinished">nichts hat gemessen, wie tief die Nadel war</translation>
        </message>
        <message>
            <source>the needle never crossed the skin: it was never inserted</source>
            <translation type="unfinished">die Nadel ging nie durch die Haut: Sie wurde nie eingeführt</translation>
        </message>
        <message>
            <source>this computer was too slow: the attempt waited {paused:.0f} s for pictures of its own simulated cameras; {allowed:g} s are allowed</source>
            <translation type="unfinished">dieser Computer war zu langsam: Der Versuch wartete {paused:.0f} s auf Bilder seiner eigenen simulierten Kameras; erlaubt sind {allowed:g} s</translation>
        </message>
        <message>
            <source>the attempt waited {paused:.0f} s for the cameras; {rules_maximum_pause:g} s are allowed</source>
            <translation type="unfinished">der Versuch wartete {paused:.0f} s auf die Kameras; erlaubt sind {rules_maximum_pause:g} s</translation>
        </message>
        <message>
            <source>the insertion was measured for {duration_s:.2f} s; smoothness needs {shortest:g} to {longest:g} s</source>
            <translation type="unfinished">die Punktion wurde {duration_s:.2f} s lang gemessen; die Bewegungsglätte braucht {shortest:g} bis {longest:g} s</translation>
        </message>
        <message>
            <source>the tip's speed never changed: it has no smoothness</source>
            <translation type="unfinished">die Geschwindigkeit der Spitze änderte sich nie: Eine Bewegungsglätte gibt es nicht</translation>
        </message>
        <message>
            <source>expert, good, pass and zero must rise or fall strictly in this order; they are </source>
            <translation type="unfinished">expert, good, pass und zero müssen in dieser Reihenfolge streng steigen oder fallen; sie sind </translation>
        </message>
        <message>
            <source>expert, good, pass and zero must be finite and 0 or more, as the sign of a value does not count; they are </source>
            <translation type="unfinished">expert, good, pass und zero müssen endlich und mindestens 0 sein, da das Vorzeichen eines Werts nicht zählt; sie sind </translation>
        </message>
        <message>
            <source>a value that is NaN has no utility</source>
            <translation type="unfinished">ein Wert, der NaN ist, hat keinen Nutzen</translation>
        </message>
        <message>
            <source>{touches} touches of {targets} targets at {times} s; they must be no more than the targets, of which one at least is needed, one after the other</source>
            <translation type="unfinished">Berührungen: {touches}, Ziele: {targets}, bei {times} s; es dürfen nicht mehr als die Ziele sein, mindestens ein Ziel ist nötig, eines nach dem anderen</translation>
        </message>
        <message>
            <source>a touch at {times} s: times must be finite</source>
            <translation type="unfinished">eine Berührung bei {times} s: Zeiten müssen endlich sein</translation>
        </message>
        <message>
            <source>agreement is {agreement} m; it must be 0 or more</source>
            <translation type="unfinished">die Übereinstimmung beträgt {agreement} m; sie muss mindestens 0 sein</translation>
        </message>
        <message>
            <source>no robot held the needle: there is no force</source>
            <translation type="unfinished">kein Roboter hielt die Nadel: Es gibt keine Kraft</translation>
        </message>
        <message>
            <source>the needle was never inserted</source>
            <translation type="unfinished">die Nadel wurde nie eingeführt</translation>
        </message>
        <message>
            <source>no tissue field told what the needle met</source>
            <translation type="unfinished">kein Gewebefeld sagte, was die Nadel traf</translation>
        </message>
        <message>
            <source>nothing was to be touched</source>
            <translation type="unfinished">es war nichts zu berühren</translation>
        </message>
        <message>
            <source>no target was touched</source>
            <translation type="unfinished">kein Ziel wurde berührt</translation>
        </message>
        <message>
            <source>the needle was out of the body at the end</source>
            <translation type="unfinished">die Nadel war am Ende außerhalb des Körpers</translation>
        </message>
        <message>
            <source>the depth of the tip was never measured</source>
            <translation type="unfinished">die Tiefe der Spitze wurde nie gemessen</translation>
        </message>
        <message>
            <source>the tip was last seen {age:.1f} s before the end</source>
            <translation type="unfinished">die Spitze wurde zuletzt {age:.1f} s vor dem Ende gesehen</translation>
        </message>
        <message>
            <source>{name} has shape {array_shape}; {wanted} is needed, as time has it</source>
            <translation type="unfinished">{name} hat die Form {array_shape}; nötig ist {wanted}, wie bei der Zeit</translation>
        </message>
        <message>
            <source>{name} is not finite within ±{largest:g} in {bad} of {samples} samples, first at sample {first}: {array}; leave such samples out</source>
            <translation type="unfinished">{name} ist in {bad} von {samples} Abtastwerten nicht endlich innerhalb von ±{largest:g}, zuerst beim Abtastwert {first}: {array}; lassen Sie solche Abtastwerte weg</translation>
        </message>
        <message>
            <source>spread has shape {array_shape}; ({n}, 3) is needed, as time has it</source>
            <translation type="unfinished">spread hat die Form {array_shape}; nötig ist ({n}, 3), wie bei der Zeit</translation>
        </message>
        <message>
            <source>time {fault} at sample {first}: {time} s after {previous_time} s</source>
            <translation type="unfinished">die Zeit {fault} beim Abtastwert {first}: {time} s nach {previous_time} s</translation>
        </message>
        <message>
            <source>axis {axis} at sample {first} is no unit vector</source>
            <translation type="unfinished">die Achse {axis} beim Abtastwert {first} ist kein Einheitsvektor</translation>
        </message>
        <message>
            <source>unknown phase '{unknown_name}'; phases are {codes}</source>
            <translation type="unfinished">unbekannte Phase „{unknown_name}“; Phasen sind {codes}</translation>
        </message>
        <message>
            <source>phase must be names or codes of Phase 0 ... {largest_code}</source>
            <translation type="unfinished">phase muss aus Namen oder aus Codes von Phase 0 … {largest_code} bestehen</translation>
        </message>
        <message>
            <source>phase has shape {codes_shape}; ({n},) is needed, as time has it</source>
            <translation type="unfinished">phase hat die Form {codes_shape}; nötig ist ({n},), wie bei der Zeit</translation>
        </message>
        <message>
            <source>depth_valid has shape {flags_shape}; ({n},) is needed</source>
            <translation type="unfinished">depth_valid hat die Form {flags_shape}; nötig ist ({n},)</translation>
        </message>
        <message>
            <source>how well the tip was known there was not recorded</source>
            <translation type="unfinished">wie genau die Spitze dort bekannt war, wurde nicht aufgezeichnet</translation>
        </message>
        <message>
            <source>how well the tip was known was not recorded</source>
            <translation type="unfinished">wie genau die Spitze bekannt war, wurde nicht aufgezeichnet</translation>
        </message>
        <message>
            <source>how well the tip was known was not recorded throughout</source>
            <translation type="unfinished">wie genau die Spitze bekannt war, wurde nicht durchgehend aufgezeichnet</translation>
        </message>
        <message>
            <source>say why it is admitted, in 1 to {longest_reason} characters: the reason is sealed with it</source>
            <translation type="unfinished">sagen Sie in 1 bis {longest_reason} Zeichen, warum er anerkannt wird: Der Grund wird mit ihm versiegelt</translation>
        </message>
        <message>
            <source>nothing is sealed at this station yet: every attempt counts as it is</source>
            <translation type="unfinished">an dieser Station ist noch nichts versiegelt: Jeder Versuch zählt, wie er ist</translation>
        </message>
        <message>
            <source>{path_stem} is {sentence}; only an unsigned attempt can be admitted</source>
            <translation type="unfinished">{path_stem} ist {sentence}; anerkannt werden kann nur ein unsignierter Versuch</translation>
        </message>
        <message>
            <source>cannot write {out}: {reason}</source>
            <translation type="unfinished">{out} lässt sich nicht schreiben: {reason}</translation>
        </message>
        <message>
            <source>without a digest, in {folder}</source>
            <translation type="unfinished">ohne Prüfsumme, in {folder}</translation>
        </message>
        <message>
            <source>the structures {file} of {path_stem}</source>
            <translation type="unfinished">die Strukturen {file} von {path_stem}</translation>
        </message>
        <message>
            <source>the CT {name} of {some}</source>
            <translation type="unfinished">das CT {name} von {some}</translation>
        </message>
        <message>
            <source>its list is too long</source>
            <translation type="unfinished">ihre Liste ist zu lang</translation>
        </message>
        <message>
            <source>{source} is no backup of Acus: {error}</source>
            <translation type="unfinished">{source} ist keine Sicherung von Acus: {error}</translation>
        </message>
        <message>
            <source>{source} is no backup of Acus: its format is {kind!r}</source>
            <translation type="unfinished">{source} ist keine Sicherung von Acus: Das Format ist {kind!r}</translation>
        </message>
        <message>
            <source>{source} was written by a newer version of Acus: use that version</source>
            <translation type="unfinished">{source} wurde von einer neueren Version von Acus geschrieben: Verwenden Sie diese Version</translation>
        </message>
        <message>
            <source>{source} is damaged: {odd_name!r} is missing in it or no name of Acus</source>
            <translation type="unfinished">{source} ist beschädigt: {odd_name!r} fehlt darin oder ist kein Name von Acus</translation>
        </message>
        <message>
            <source>{source} is damaged at {name}: {error}</source>
            <translation type="unfinished">{source} ist beschädigt bei {name}: {error}</translation>
        </message>
        <message>
            <source>{source} is damaged: {name} is not what was packed</source>
            <translation type="unfinished">{source} ist beschädigt: {name} ist nicht, was eingepackt wurde</translation>
        </message>
        <message>
            <source>a block of {block_bytes} bytes does not begin with {magic}</source>
            <translation type="unfinished">ein Block von {block_bytes} Byte beginnt nicht mit {magic}</translation>
        </message>
        <message>
            <source>block version {version}; this program reads {known_version}</source>
            <translation type="unfinished">Blockversion {version}; dieses Programm liest {known_version}</translation>
        </message>
        <message>
            <source>a block of {rows} rows has {block_bytes} bytes</source>
            <translation type="unfinished">ein Block mit {rows} Zeilen hat {block_bytes} Byte</translation>
        </message>
        <message>
            <source>a block of {count} columns has no tick numbers</source>
            <translation type="unfinished">ein Block mit {count} Spalten hat keine Taktnummern</translation>
        </message>
        <message>
            <source>a block of 0 rows has {body_bytes} bytes of numbers</source>
            <translation type="unfinished">ein Block mit 0 Zeilen hat {body_bytes} Byte an Zahlen</translation>
        </message>
        <message>
            <source>a block of {rows} rows has {check_bytes} bytes of checks</source>
            <translation type="unfinished">ein Block mit {rows} Zeilen hat {check_bytes} Byte an Prüfwerten</translation>
        </message>
        <message>
            <source>altered after it was signed</source>
            <translation type="unfinished">nach dem Signieren verändert</translation>
        </message>
        <message>
            <source>declared void by the instructor</source>
            <translation type="unfinished">vom Kursleiter für ungültig erklärt</translation>
        </message>
        <message>
            <source>not sealed by this station</source>
            <translation type="unfinished">nicht von dieser Station versiegelt</translation>
        </message>
        <message>
            <source>carried out by the arm</source>
            <translation type="unfinished">vom Arm ausgeführt</translation>
        </message>
        <message>
            <source>not scored or void</source>
            <translation type="unfinished">nicht bewertet oder ungültig</translation>
        </message>
        <message>
            <source>version {entry_version} of the exercise</source>
            <translation type="unfinished">Version {entry_version} der Übung</translation>
        </message>
        <message>
            <source>the exercise said something else</source>
            <translation type="unfinished">die Übung sagte etwas anderes</translation>
        </message>
        <message>
            <source>{name} has {size:.1f} MB and would take more than {allowed:.0f} MB of memory to be read, which no attempt does: it is damaged or hostile; move it out of the folder</source>
            <translation type="unfinished">{name} hat {size:.1f} MB und bräuchte zum Lesen mehr als {allowed:.0f} MB Speicher, was kein Versuch tut: Die Datei ist beschädigt oder bösartig; nehmen Sie sie aus dem Ordner</translation>
        </message>
        <message>
            <source>it holds more than the {most} bytes that it should</source>
            <translation type="unfinished">sie enthält mehr als die {most} Byte, die sie haben sollte</translation>
        </message>
        <message>
            <source>whether calibration {calibration} is still good is not known: {unknown}</source>
            <translation type="unfinished">ob die Kalibrierung {calibration} noch gut ist, ist nicht bekannt: {unknown}</translation>
        </message>
        <message>
            <source>the cameras' calibration {calibration} was later found bad: {reason}</source>
            <translation type="unfinished">die Kamerakalibrierung {calibration} erwies sich später als schlecht: {reason}</translation>
        </message>
        <message>
            <source>a checkpoint does not begin with {magic}</source>
            <translation type="unfinished">ein Sicherungspunkt beginnt nicht mit {magic}</translation>
        </message>
        <message>
            <source>checkpoint version {version}; this program reads {known_version}</source>
            <translation type="unfinished">Version {version} des Sicherungspunkts; dieses Programm liest {known_version}</translation>
        </message>
        <message>
            <source>the checkpoint cannot be read: {error}</source>
            <translation type="unfinished">der Sicherungspunkt lässt sich nicht lesen: {error}</translation>
        </message>
        <message>
            <source>{numbers_given} numbers for {slots} slots and {sizes} more</source>
            <translation type="unfinished">Zahlen: {numbers_given}, für Plätze: {slots}, und weitere: {sizes}</translation>
        </message>
        <message>
            <source>the robot's loop does not run</source>
            <translation type="unfinished">die Regelschleife des Roboters läuft nicht</translation>
        </message>
        <message>
            <source>wait a moment; if it stays so, check cable and power, start the exercise again</source>
            <translation type="unfinished">warten Sie einen Moment; bleibt es so, prüfen Sie Kabel und Strom und starten Sie die Übung neu</translation>
        </message>
        <message>
            <source>simulated robot: its zero is known</source>
            <translation type="unfinished">simulierter Roboter: Sein Nullpunkt ist bekannt</translation>
        </message>
        <message>
            <source>homed since it was switched on</source>
            <translation type="unfinished">seit dem Einschalten referenziert</translation>
        </message>
        <message>
            <source>not homed since it was switched on</source>
            <translation type="unfinished">seit dem Einschalten nicht referenziert</translation>
        </message>
        <message>
            <source>menu Robot, Commissioning, step Homing</source>
            <translation type="unfinished">Menü Roboter, Inbetriebnahme, Schritt Referenzfahrt</translation>
        </message>
        <message>
            <source>simulated robot: its signs are known</source>
            <translation type="unfinished">simulierter Roboter: Seine Vorzeichen sind bekannt</translation>
        </message>
        <message>
            <source>motors and encoders agree</source>
            <translation type="unfinished">Motoren und Encoder stimmen überein</translation>
        </message>
        <message>
            <source>not checked since it was switched on</source>
            <translation type="unfinished">seit dem Einschalten nicht kontrolliert</translation>
        </message>
        <message>
            <source>menu Robot, Commissioning, step Signs</source>
            <translation type="unfinished">Menü Roboter, Inbetriebnahme, Schritt Vorzeichenkontrolle</translation>
        </message>
        <message>
            <source>do what the message says; see the page Robot</source>
            <translation type="unfinished">tun Sie, was die Meldung sagt; siehe Seite Roboter</translation>
        </message>
        <message>
            <source>joint angles come late, so the force is held back</source>
            <translation type="unfinished">Gelenkwinkel kommen zu spät, daher ist die Kraft gedrosselt</translation>
        </message>
        <message>
            <source>check the robot's cable; close other programs</source>
            <translation type="unfinished">prüfen Sie das Kabel des Roboters; schließen Sie andere Programme</translation>
        </message>
        <message>
            <source>cleared for its full force</source>
            <translation type="unfinished">für die volle Kraft freigegeben</translation>
        </message>
        <message>
            <source>the robot has not said yet</source>
            <translation type="unfinished">der Roboter hat sich noch nicht gemeldet</translation>
        </message>
        <message>
            <source>plug both cameras in; menu Cameras</source>
            <translation type="unfinished">schließen Sie beide Kameras an; Menü Kameras</translation>
        </message>
        <message>
            <source>both bright and sharp, {rates} a second</source>
            <translation type="unfinished">beide hell und scharf, {rates} pro Sekunde</translation>
        </message>
        <message>
            <source>found in both pictures</source>
            <translation type="unfinished">in beiden Bildern gefunden</translation>
        </message>
        <message>
            <source>no pictures yet</source>
            <translation type="unfinished">noch keine Bilder</translation>
        </message>
        <message>
            <source>only one camera</source>
            <translation type="unfinished">nur eine Kamera</translation>
        </message>
        <message>
            <source>push the needle on until both cameras see the red band; look for other red things</source>
            <translation type="unfinished">schieben Sie die Nadel vor, bis beide Kameras das rote Band sehen; achten Sie auf andere rote Dinge</translation>
        </message>
        <message>
            <source>no point yet</source>
            <translation type="unfinished">noch kein Punkt</translation>
        </message>
        <message>
            <source>the marker must be seen by both cameras</source>
            <translation type="unfinished">beide Kameras müssen den Marker sehen</translation>
        </message>
        <message>
            <source>a camera was moved, or robot and cameras differ: `acus calibrate world`</source>
            <translation type="unfinished">eine Kamera wurde bewegt, oder Roboter und Kameras stimmen nicht überein: `acus calibrate world`</translation>
        </message>
        <message>
            <source>a camera was bumped? calibrate again: menu Cameras</source>
            <translation type="unfinished">wurde eine Kamera angestoßen? Kalibrieren Sie neu: Menü Kameras</translation>
        </message>
        <message>
            <source>Touch one point</source>
            <translation type="unfinished">Einen Punkt berühren</translation>
        </message>
        <message>
            <source>not touched yet</source>
            <translation type="unfinished">noch nicht berührt</translation>
        </message>
        <message>
            <source>rest the tip in a known mark and hold still for a second</source>
            <translation type="unfinished">setzen Sie die Spitze auf eine bekannte Marke und halten Sie eine Sekunde still</translation>
        </message>
        <message>
            <source>{touch_name}: {distance:.2f} mm off, measured to ± {radius:.2f} mm (95 %)</source>
            <translation type="unfinished">{touch_name}: {distance:.2f} mm daneben, gemessen auf ± {radius:.2f} mm (95 %)</translation>
        </message>
        <message>
            <source>the cameras do not measure this point well enough to tell: look at their pictures and rate, touch again</source>
            <translation type="unfinished">die Kameras messen diesen Punkt nicht genau genug für eine Aussage: Sehen Sie sich ihre Bilder und ihre Bildrate an und berühren Sie ihn noch einmal</translation>
        </message>
        <message>
            <source>the limit is {touch_tolerance_mm:.1f} mm</source>
            <translation type="unfinished">die Grenze ist {touch_tolerance_mm:.1f} mm</translation>
        </message>
        <message>
            <source>{limit}: touch again; is it {touch_name}, is the plate in its place? then check with all fiducials: menu Checks, Registration check</source>
            <translation type="unfinished">{limit}: Berühren Sie noch einmal; ist es {touch_name}, liegt die Platte an ihrem Platz? Prüfen Sie dann mit allen Referenzmarken: Menü Kontrollen, Registrierungskontrolle</translation>
        </message>
        <message>
            <source>a block ends after {block_bytes} bytes in a column</source>
            <translation type="unfinished">ein Block endet nach {block_bytes} Byte mitten in einer Spalte</translation>
        </message>
        <message>
            <source>a column is stored in a way, {code}, that is not known</source>
            <translation type="unfinished">eine Spalte ist auf eine unbekannte Weise gespeichert: {code}</translation>
        </message>
        <message>
            <source>a column repeats column {index}, which is not before it</source>
            <translation type="unfinished">eine Spalte wiederholt die Spalte {index}, die nicht vor ihr steht</translation>
        </message>
        <message>
            <source>hand {hand!r} is not known; valid names: {hands}</source>
            <translation type="unfinished">die Hand {hand!r} ist nicht bekannt; gültige Namen: {hands}</translation>
        </message>
        <message>
            <source>too slow: the attempt waited {waited:.0f} s for its simulated cameras</source>
            <translation type="unfinished">zu langsam: Der Versuch wartete {waited:.0f} s auf seine simulierten Kameras</translation>
        </message>
        <message>
            <source>too slow by {lost:.0f} s: the simulated world was slowed with it</source>
            <translation type="unfinished">um {lost:.0f} s zu langsam: Die simulierte Welt wurde mitverlangsamt</translation>
        </message>
        <message>
            <source>control scan {scan_number} at {time:.1f} s: {order_slices} slices of {order_slice_mm:g} mm about z {order_centre_mm:.1f} mm, {seen_words}, {dose:.1f} mGy·cm ({teaching_estimate})</source>
            <translation type="unfinished">Kontrollscan {scan_number} bei {time:.1f} s: Schichten: {order_slices} zu {order_slice_mm:g} mm um z {order_centre_mm:.1f} mm, {seen_words}, {dose:.1f} mGy·cm ({teaching_estimate})</translation>
        </message>
        <message>
            <source>no control scan: the needle's depth is not measured now, so that a picture would be a guess; nothing was counted. Let both cameras see the marker and press again</source>
            <translation type="unfinished">kein Kontrollscan: Die Tiefe der Nadel wird gerade nicht gemessen, ein Bild wäre also geraten; es wurde nichts gezählt. Sorgen Sie dafür, dass beide Kameras den Marker sehen, und drücken Sie noch einmal</translation>
        </message>
        <message>
            <source>closes on {closes}, before it opens on {opens}</source>
            <translation type="unfinished">schließt am {closes}, bevor er am {opens} öffnet</translation>
        </message>
        <message>
            <source>{exercise_name!r} stands there twice: an exercise has one place</source>
            <translation type="unfinished">{exercise_name!r} steht zweimal da: Eine Übung hat einen Platz</translation>
        </message>
        <message>
            <source>{name!r} is no course; there: {known}</source>
            <translation type="unfinished">{name!r} ist kein Kurs; vorhanden: {known}</translation>
        </message>
        <message>
            <source>{item_exercise}: no such exercise in the library</source>
            <translation type="unfinished">{item_exercise}: keine solche Übung in der Bibliothek</translation>
        </message>
        <message>
            <source>{item_exercise}: the library has version {known}, the course pins version {item_version}</source>
            <translation type="unfinished">{item_exercise}: Die Bibliothek hat Version {known}, der Kurs legt Version {item_version} fest</translation>
        </message>
        <message>
            <source>{named} is no exercise of the course {course_title}</source>
            <translation type="unfinished">{named} ist keine Übung des Kurses {course_title}</translation>
        </message>
        <message>
            <source>it opens on {item_opens}</source>
            <translation type="unfinished">sie öffnet am {item_opens}</translation>
        </message>
        <message>
            <source>it closed on {item_closes}</source>
            <translation type="unfinished">sie schloss am {item_closes}</translation>
        </message>
        <message>
            <source>all {item_attempts} attempts are used</source>
            <translation type="unfinished">alle {item_attempts} Versuche sind verbraucht</translation>
        </message>
        <message>
            <source>the one attempt is used</source>
            <translation type="unfinished">der eine Versuch ist verbraucht</translation>
        </message>
        <message>
            <source>as its files are</source>
            <translation type="unfinished">wie in den Dateien</translation>
        </message>
        <message>
            <source>cannot be deleted: {error_strerror}</source>
            <translation type="unfinished">lässt sich nicht löschen: {error_strerror}</translation>
        </message>
        <message>
            <source>was written by a newer version of Acus (form {found_version}, this one knows {known_version}): use that version</source>
            <translation type="unfinished">wurde von einer neueren Version von Acus geschrieben (Form {found_version}, diese kennt {known_version}): Verwenden Sie diese Version</translation>
        </message>
        <message>
            <source>the {database_name} {path} {reason}</source>
            <translation type="unfinished">{database_name} {path} {reason}</translation>
        </message>
        <message>
            <source>effect {effect} is computed by its model {model} from here on</source>
            <translation type="unfinished">der Effekt {effect} wird ab hier mit seinem Modell {model} berechnet</translation>
        </message>
        <message>
            <source>{lie} in {folder}, where earlier versions kept attempts: `acus session gather` brings yours here, `acus session list --folder {folder}` lists all</source>
            <translation type="unfinished">{lie} in {folder}, wo frühere Versionen Versuche ablegten: `acus session gather` holt Ihre hierher, `acus session list --folder {folder}` listet alle auf</translation>
        </message>
        <message>
            <source>cannot bring attempts here: {place}: {error_strerror}</source>
            <translation type="unfinished">Versuche lassen sich nicht hierher holen: {place}: {error_strerror}</translation>
        </message>
        <message>
            <source>cannot delete: {error_strerror}</source>
            <translation type="unfinished">Löschen nicht möglich: {error_strerror}</translation>
        </message>
        <message>
            <source>the record's plan has no {error}</source>
            <translation type="unfinished">dem Plan der Aufzeichnung fehlt {error}</translation>
        </message>
        <message>
            <source>the record's plan is not usable: {error}</source>
            <translation type="unfinished">der Plan der Aufzeichnung ist nicht verwendbar: {error}</translation>
        </message>
        <message>
            <source>{agreed} of {agreeing} pictures agree so far</source>
            <translation type="unfinished">bisher stimmen {agreed} von {agreeing} Bildern überein</translation>
        </message>
        <message>
            <source>the cameras' depth jumped by {jump_mm:.0f} mm, faster than a hand moves a needle: {count}</source>
            <translation type="unfinished">die Tiefe laut Kameras sprang um {jump_mm:.0f} mm, schneller, als eine Hand eine Nadel bewegt: {count}</translation>
        </message>
        <message>
            <source>the cameras have just found the marker: {count}</source>
            <translation type="unfinished">die Kameras haben den Marker gerade erst gefunden: {count}</translation>
        </message>
        <message>
            <source>the robot gives no needle direction</source>
            <translation type="unfinished">der Roboter gibt keine Nadelrichtung an</translation>
        </message>
        <message>
            <source>the robot gives no needle position</source>
            <translation type="unfinished">der Roboter gibt keine Nadelposition an</translation>
        </message>
        <message>
            <source>the encoder values are {text_ms} old, the limit is {encoder_zero:.0f} ms</source>
            <translation type="unfinished">die Encoderwerte sind {text_ms} alt, die Grenze ist {encoder_zero:.0f} ms</translation>
        </message>
        <message>
            <source>an unknown time</source>
            <translation type="unfinished">unbekannt lange</translation>
        </message>
        <message>
            <source>session id {session_id!r} is not usable: letters, digits, '.', '_' and '-', at most 64, beginning with a letter or digit</source>
            <translation type="unfinished">die Sitzungskennung {session_id!r} ist nicht verwendbar: Buchstaben, Ziffern, '.', '_' und '-', höchstens 64, am Anfang ein Buchstabe oder eine Ziffer</translation>
        </message>
        <message>
            <source>{name}: {row!r} in the index, {right!r} by the record</source>
            <translation type="unfinished">{name}: {row!r} im Verzeichnis, {right!r} laut Aufzeichnung</translation>
        </message>
        <message>
            <source>its row was not written by this station</source>
            <translation type="unfinished">seine Zeile wurde nicht von dieser Station geschrieben</translation>
        </message>
        <message>
            <source>the robot is not homed</source>
            <translation type="unfinished">der Roboter ist nicht referenziert</translation>
        </message>
        <message>
            <source>{path_stem} is being written by a running program: end its attempt there, or try again {quiet_s:.0f} s after that program has gone</source>
            <translation type="unfinished">{path_stem} wird von einem laufenden Programm geschrieben: Beenden Sie den Versuch dort, oder versuchen Sie es {quiet_s:.0f} s nach dem Ende dieses Programms noch einmal</translation>
        </message>
        <message>
            <source>cannot recover {path}: {error_strerror}</source>
            <translation type="unfinished">{path} lässt sich nicht wiederherstellen: {error_strerror}</translation>
        </message>
        <message>
            <source>{path_stem} was {reason} and cannot be recovered from itself; a backup may hold it whole (`acus store restore`)</source>
            <translation type="unfinished">{path_stem} wurde {reason} und lässt sich nicht aus sich selbst wiederherstellen; eine Sicherung enthält den Versuch vielleicht ganz (`acus store restore`)</translation>
        </message>
        <message>
            <source>cannot write in {folder}: {error_strerror}; nothing was changed</source>
            <translation type="unfinished">in {folder} lässt sich nicht schreiben: {error_strerror}; es wurde nichts geändert</translation>
        </message>
        <message>
            <source>cannot change {problem_filename}: {problem_strerror}; it is tried again at the next start</source>
            <translation type="unfinished">{problem_filename} lässt sich nicht ändern: {problem_strerror}; beim nächsten Start wird es noch einmal versucht</translation>
        </message>
        <message>
            <source>another program has been changing {folder} for {patience:g} s: wait until it is done, then try again</source>
            <translation type="unfinished">ein anderes Programm ändert {folder} seit {patience:g} s: Warten Sie, bis es fertig ist, und versuchen Sie es dann noch einmal</translation>
        </message>
        <message>
            <source>'{event}' is not possible while {attempt_state}; possible: {names}</source>
            <translation type="unfinished">„{event}“ ist im Zustand {attempt_state} nicht möglich; möglich: {names}</translation>
        </message>
        <message>
            <source>'{event}' at {time} s lies before the last change at {attempt_since} s</source>
            <translation type="unfinished">„{event}“ bei {time} s liegt vor der letzten Änderung bei {attempt_since} s</translation>
        </message>
        <message>
            <source>session {header_id} exists already ({path}): every attempt needs its own id</source>
            <translation type="unfinished">die Sitzung {header_id} gibt es schon ({path}): Jeder Versuch braucht seine eigene Kennung</translation>
        </message>
        <message>
            <source>cannot record to {path}: {reason}</source>
            <translation type="unfinished">in {path} lässt sich nicht aufzeichnen: {reason}</translation>
        </message>
        <message>
            <source>the record {path} is not open</source>
            <translation type="unfinished">die Aufzeichnung {path} ist nicht geöffnet</translation>
        </message>
        <message>
            <source>cannot record to {folder}: it is a file, not a folder</source>
            <translation type="unfinished">in {folder} lässt sich nicht aufzeichnen: Das ist eine Datei, kein Ordner</translation>
        </message>
        <message>
            <source>the cameras saw the needle for less than a second of this attempt</source>
            <translation type="unfinished">die Kameras sahen die Nadel bei diesem Versuch weniger als eine Sekunde lang</translation>
        </message>
        <message>
            <source>{exercise!r} is no identifier of an exercise</source>
            <translation type="unfinished">{exercise!r} ist keine Kennung einer Übung</translation>
        </message>
        <message>
            <source>the loop does not run</source>
            <translation type="unfinished">die Regelschleife läuft nicht</translation>
        </message>
        <message>
            <source>the loop has stopped: its newest state is {age:.1f} s old</source>
            <translation type="unfinished">die Regelschleife steht: Ihr neuester Zustand ist {age:.1f} s alt</translation>
        </message>
        <message>
            <source>the robot is still starting: begin once it reports its pose</source>
            <translation type="unfinished">der Roboter startet noch: Beginnen Sie, sobald er seine Lage meldet</translation>
        </message>
        <message>
            <source>the program has had a fault: close the exercise, open it again</source>
            <translation type="unfinished">im Programm ist ein Fehler aufgetreten: Schließen Sie die Übung und öffnen Sie sie wieder</translation>
        </message>
        <message>
            <source>the patient holds the breath, for {now_left:.0f} s at most</source>
            <translation type="unfinished">der Patient hält den Atem an, noch höchstens {now_left:.0f} s</translation>
        </message>
        <message>
            <source>the patient could hold no longer and breathes: release him, and ask again</source>
            <translation type="unfinished">der Patient konnte nicht länger und atmet: Lassen Sie ihn atmen und bitten Sie ihn dann noch einmal</translation>
        </message>
        <message>
            <source>the patient is told to hold</source>
            <translation type="unfinished">der Patient soll den Atem anhalten</translation>
        </message>
        <message>
            <source>the patient may breathe</source>
            <translation type="unfinished">der Patient darf atmen</translation>
        </message>
        <message>
            <source>pad scale needs a path length and a tolerance between 0 and 10 m, got {length} and {tolerance}</source>
            <translation type="unfinished">der Maßstab der Zielscheibe braucht eine Pfadlänge und eine Toleranz zwischen 0 und 10 m, angegeben sind {length} und {tolerance}</translation>
        </message>
        <message>
            <source>tilt limit {limit} rad is outside [0, π/2)</source>
            <translation type="unfinished">die Neigungsgrenze {limit} rad liegt außerhalb von [0, π/2)</translation>
        </message>
        <message>
            <source>hand limits need a tilt in [0, π/2) and shallowest &lt; deepest, got {this}</source>
            <translation type="unfinished">die Grenzen der Hand brauchen eine Neigung in [0, π/2) und shallowest &lt; deepest, angegeben ist {this}</translation>
        </message>
        <message>
            <source>a handle needs a tool longer than {least_outside} m and shorter than 10 m and a reach between 0 and 10 m, got {this}</source>
            <translation type="unfinished">ein Griff braucht ein Instrument, das länger als {least_outside} m und kürzer als 10 m ist, und eine Reichweite zwischen 0 und 10 m, angegeben ist {this}</translation>
        </message>
        <message>
            <source>depth step {step} is not finite</source>
            <translation type="unfinished">der Tiefenschritt {step} ist nicht endlich</translation>
        </message>
        <message>
            <source>there is an instructor already: change the password instead</source>
            <translation type="unfinished">es gibt schon einen Kursleiter: Ändern Sie stattdessen das Passwort</translation>
        </message>
        <message>
            <source>no instructor is set: `acus people instructor` sets a password</source>
            <translation type="unfinished">es ist kein Kursleiter eingerichtet: `acus people instructor` legt ein Passwort fest</translation>
        </message>
        <message>
            <source>this recovery key is one of an earlier build, in a form that is no longer read: change the password with the one that holds (`acus people instructor`), which prints a new recovery key; if nobody knows it, move {folder} away and begin a new list of people</source>
            <translation type="unfinished">dieser Wiederherstellungsschlüssel stammt von einer früheren Fassung und hat eine Form, die nicht mehr gelesen wird: Ändern Sie das Passwort mit dem gültigen (`acus people instructor`), das druckt einen neuen Wiederherstellungsschlüssel; kennt es niemand, legen Sie {folder} beiseite und beginnen Sie eine neue Personenliste</translation>
        </message>
        <message>
            <source>{pseudonym!r} is no student here; there: {some}</source>
            <translation type="unfinished">{pseudonym!r} ist hier kein Teilnehmer; vorhanden: {some}</translation>
        </message>
        <message>
            <source>{line_pseudonym!r} is taken: choose another pseudonym</source>
            <translation type="unfinished">{line_pseudonym!r} ist vergeben: Wählen Sie ein anderes Pseudonym</translation>
        </message>
        <message>
            <source>{no_sign_in}: try again</source>
            <translation type="unfinished">{no_sign_in}: Versuchen Sie es noch einmal</translation>
        </message>
        <message>
            <source>{path} is damaged: bring it back from a backup, or move it away to go on without names</source>
            <translation type="unfinished">{path} ist beschädigt: Holen Sie die Datei aus einer Sicherung zurück, oder legen Sie sie beiseite, um ohne Namen weiterzuarbeiten</translation>
        </message>
        <message>
            <source>a password needs at least {shortest_password} characters</source>
            <translation type="unfinished">ein Passwort braucht mindestens {shortest_password} Zeichen</translation>
        </message>
        <message>
            <source>the people of {whose} were written by a newer version of Acus: use that version; nothing was changed</source>
            <translation type="unfinished">die Personen von {whose} wurden von einer neueren Version von Acus geschrieben: Verwenden Sie diese Version; es wurde nichts geändert</translation>
        </message>
        <message>
            <source>it is empty, or of another program</source>
            <translation type="unfinished">sie ist leer oder von einem anderen Programm</translation>
        </message>
        <message>
            <source>{students} ({shown}): their attempts are nobody's here</source>
            <translation type="unfinished">{students} ({shown}): Ihre Versuche gehören hier niemandem</translation>
        </message>
        <message>
            <source>it has no table {name!r}</source>
            <translation type="unfinished">sie hat keine Tabelle {name!r}</translation>
        </message>
        <message>
            <source>persons.key holds {key!r}</source>
            <translation type="unfinished">persons.key enthält {key!r}</translation>
        </message>
        <message>
            <source>persons.pseudonym: {error}</source>
            <translation type="unfinished">persons.pseudonym: {error}</translation>
        </message>
        <message>
            <source>persons.pseudonym holds one twice</source>
            <translation type="unfinished">persons.pseudonym enthält eines doppelt</translation>
        </message>
        <message>
            <source>the people of {whose} cannot be restored: {reason}; nothing was changed</source>
            <translation type="unfinished">die Personen von {whose} lassen sich nicht wiederherstellen: {reason}; es wurde nichts geändert</translation>
        </message>
        <message>
            <source>{path_name} holds no plan: it was cut off at its beginning</source>
            <translation type="unfinished">{path_name} enthält keinen Plan: Die Datei wurde am Anfang abgeschnitten</translation>
        </message>
        <message>
            <source>{path_name} holds no session: </source>
            <translation type="unfinished">{path_name} enthält keine Sitzung: </translation>
        </message>
        <message>
            <source>compared were only the slots that the record holds by value</source>
            <translation type="unfinished">verglichen wurden nur die Plätze, deren Wert die Aufzeichnung enthält</translation>
        </message>
        <message>
            <source>{count} ticks from tick {first} on are not in the record</source>
            <translation type="unfinished">ab Takt {first} fehlen Takte in der Aufzeichnung: {count}</translation>
        </message>
        <message>
            <source>the replay ends there: {left} recorded ticks were not recomputed</source>
            <translation type="unfinished">die Wiedergabe endet dort: Nicht nachgerechnete aufgezeichnete Takte: {left}</translation>
        </message>
        <message>
            <source>with another build, differences in the last digits are expected</source>
            <translation type="unfinished">bei einer anderen Programmfassung sind Unterschiede in den letzten Stellen zu erwarten</translation>
        </message>
        <message>
            <source>identical over {ticks} ticks ({seconds:.1f} s)</source>
            <translation type="unfinished">identisch über {ticks} Takte ({seconds:.1f} s)</translation>
        </message>
        <message>
            <source>differs from tick {first_difference_tick} on: {difference}</source>
            <translation type="unfinished">weicht ab Takt {first_difference_tick} ab: {difference}</translation>
        </message>
        <message>
            <source>; the largest difference is in tick {most_seen_at}: {difference}</source>
            <translation type="unfinished">; der größte Unterschied liegt bei Takt {most_seen_at}: {difference}</translation>
        </message>
        <message>
            <source>at {d_time:.4f} s, in a slot that is not recorded in every tick</source>
            <translation type="unfinished">bei {d_time:.4f} s, in einem Platz, der nicht in jedem Takt aufgezeichnet wird</translation>
        </message>
        <message>
            <source> (as seen in tick {d_seen_at})</source>
            <translation type="unfinished"> (wie in Takt {d_seen_at} gesehen)</translation>
        </message>
        <message>
            <source>{d_slot} was {d_recorded!r}, is now {d_recomputed!r}{size}{where}</source>
            <translation type="unfinished">{d_slot} war {d_recorded!r}, ist jetzt {d_recomputed!r}{size}{where}</translation>
        </message>
        <message>
            <source>it holds no checkpoint of the loop: its beginning is damaged</source>
            <translation type="unfinished">sie enthält keinen Sicherungspunkt der Regelschleife: Ihr Anfang ist beschädigt</translation>
        </message>
        <message>
            <source>it holds no tick of the loop</source>
            <translation type="unfinished">sie enthält keinen Takt der Regelschleife</translation>
        </message>
        <message>
            <source>ticks {start} to {tick} are missing at its beginning</source>
            <translation type="unfinished">am Anfang fehlen die Takte {start} bis {tick}</translation>
        </message>
        <message>
            <source>its program's state had other slots than this one's: {missing}</source>
            <translation type="unfinished">der Zustand ihres Programms hatte andere Plätze als der von diesem: {missing}</translation>
        </message>
        <message>
            <source>this record cannot be replayed: {reason}</source>
            <translation type="unfinished">diese Aufzeichnung lässt sich nicht wiedergeben: {reason}</translation>
        </message>
        <message>
            <source>this record cannot be replayed: models were chosen while it ran</source>
            <translation type="unfinished">diese Aufzeichnung lässt sich nicht wiedergeben: Während sie lief, wurden Modelle gewählt</translation>
        </message>
        <message>
            <source>the simulated robot</source>
            <translation type="unfinished">simulierter Roboter</translation>
        </message>
        <message>
            <source>{ticks} ticks ({seconds:.1f} s at {rate_hz:.0f} Hz) of {robot}, {missed} deadlines missed</source>
            <translation type="unfinished">{ticks} Takte ({seconds:.1f} s bei {rate_hz:.0f} Hz), {robot}, versäumte Fristen: {missed}</translation>
        </message>
        <message>
            <source>can be replayed: add --check</source>
            <translation type="unfinished">lässt sich wiedergeben: mit --check aufrufen</translation>
        </message>
        <message>
            <source>inputs that change (how often): {inputs}</source>
            <translation type="unfinished">Eingaben, die sich ändern (wie oft): {inputs}</translation>
        </message>
        <message>
            <source>{count} ticks from tick {first} on are missing</source>
            <translation type="unfinished">ab Takt {first} fehlen Takte: {count}</translation>
        </message>
        <message>
            <source>{source} is no backup of Acus, or damaged: {error}</source>
            <translation type="unfinished">{source} ist keine Sicherung von Acus oder ist beschädigt: {error}</translation>
        </message>
        <message>
            <source>cannot restore {source}: {reason} ({error_filename})</source>
            <translation type="unfinished">{source} lässt sich nicht wiederherstellen: {reason} ({error_filename})</translation>
        </message>
        <message>
            <source>the names in {at_source} are damaged; nothing was changed</source>
            <translation type="unfinished">die Namen in {at_source} sind beschädigt; es wurde nichts geändert</translation>
        </message>
        <message>
            <source>altered after it was signed: {check}; it has no points</source>
            <translation type="unfinished">nach dem Signieren verändert: {check}; der Versuch hat keine Punkte</translation>
        </message>
        <message>
            <source>the attempt left nothing to show: no valid pose</source>
            <translation type="unfinished">der Versuch hinterließ nichts zum Zeigen: keine gültige Lage</translation>
        </message>
        <message>
            <source>{nearness}; inside for {inside_s:.1f} s</source>
            <translation type="unfinished">{nearness}; {inside_s:.1f} s lang innerhalb</translation>
        </message>
        <message>
            <source>{depth_mm:.1f} mm deep in {structure}</source>
            <translation type="unfinished">{depth_mm:.1f} mm tief in {structure}</translation>
        </message>
        <message>
            <source>{distance_mm:.1f} mm from {structure}</source>
            <translation type="unfinished">{distance_mm:.1f} mm von {structure} entfernt</translation>
        </message>
        <message>
            <source>needle {place} at the closest; limit {limit_mm:g} mm: too near</source>
            <translation type="unfinished">Nadel am nächsten Punkt {place}; Grenze {limit_mm:g} mm: zu nah</translation>
        </message>
        <message>
            <source>needle {place} at the closest; limit {limit_mm:g} mm: kept</source>
            <translation type="unfinished">Nadel am nächsten Punkt {place}; Grenze {limit_mm:g} mm: eingehalten</translation>
        </message>
        <message>
            <source>{whose}a PIN has 4 to 12 digits</source>
            <translation type="unfinished">{whose}eine PIN hat 4 bis 12 Ziffern</translation>
        </message>
        <message>
            <source>the pseudonym is empty: give one</source>
            <translation type="unfinished">das Pseudonym ist leer: Geben Sie eines an</translation>
        </message>
        <message>
            <source>the pseudonym {beginning!r}… has over {longest_pseudonym} characters</source>
            <translation type="unfinished">das Pseudonym {beginning!r}… hat über {longest_pseudonym} Zeichen</translation>
        </message>
        <message>
            <source>{pseudonym!r} cannot be a pseudonym: letters, digits, blanks and . _ @ + - only, beginning with a letter or digit</source>
            <translation type="unfinished">{pseudonym!r} kann kein Pseudonym sein: nur Buchstaben, Ziffern, Leerzeichen und . _ @ + -, am Anfang ein Buchstabe oder eine Ziffer</translation>
        </message>
        <message>
            <source>{pseudonym!r} looks like a key of this program: choose another pseudonym</source>
            <translation type="unfinished">{pseudonym!r} sieht aus wie ein Schlüssel dieses Programms: Wählen Sie ein anderes Pseudonym</translation>
        </message>
        <message>
            <source>{pseudonym!r} stands there twice: delete one row</source>
            <translation type="unfinished">{pseudonym!r} steht zweimal da: Löschen Sie eine Zeile</translation>
        </message>
        <message>
            <source>the cameras see the needle again: the depth is measured</source>
            <translation type="unfinished">die Kameras sehen die Nadel wieder: Die Tiefe wird gemessen</translation>
        </message>
        <message>
            <source>the cameras have not seen the needle for {tracker_hold:.0f} ms</source>
            <translation type="unfinished">die Kameras haben die Nadel seit {tracker_hold:.0f} ms nicht gesehen</translation>
        </message>
        <message>
            <source>{reason}: from now on the depth is not measured, and the force is held back as if the needle could be anywhere</source>
            <translation type="unfinished">{reason}: Ab jetzt wird die Tiefe nicht gemessen, und die Kraft wird gedrosselt, als könnte die Nadel überall sein</translation>
        </message>
        <message>
            <source>{refusal} while {attempt_state}: end the attempt first</source>
            <translation type="unfinished">{refusal} im Zustand {attempt_state}: Beenden Sie zuerst den Versuch</translation>
        </message>
        <message>
            <source>a control scan is not possible while {attempt_state}: begin an attempt first</source>
            <translation type="unfinished">im Zustand {attempt_state} ist kein Kontrollscan möglich: Beginnen Sie zuerst einen Versuch</translation>
        </message>
        <message>
            <source>no attempt has begun</source>
            <translation type="unfinished">es hat kein Versuch begonnen</translation>
        </message>
        <message>
            <source>{samples_file} does not begin with {magic}</source>
            <translation type="unfinished">{samples_file} beginnt nicht mit {magic}</translation>
        </message>
        <message>
            <source>{samples_file} has version {version}, not {known_version}</source>
            <translation type="unfinished">{samples_file} hat Version {version}, nicht {known_version}</translation>
        </message>
        <message>
            <source>{samples_file} is damaged: its checksum is another</source>
            <translation type="unfinished">{samples_file} ist beschädigt: Die Prüfsumme ist eine andere</translation>
        </message>
        <message>
            <source>{samples_file} cannot be read: {error}</source>
            <translation type="unfinished">{samples_file} lässt sich nicht lesen: {error}</translation>
        </message>
        <message>
            <source>{rows} rows of {columns} columns in {block_bytes} bytes</source>
            <translation type="unfinished">Zeilen: {rows}, Spalten: {columns}, in {block_bytes} Byte</translation>
        </message>
        <message>
            <source>it lacks {missing}</source>
            <translation type="unfinished">es fehlt {missing}</translation>
        </message>
        <message>
            <source>a word of more than {longest_word} characters</source>
            <translation type="unfinished">ein Wort mit mehr als {longest_word} Zeichen</translation>
        </message>
        <message>
            <source>a record in it is cut off</source>
            <translation type="unfinished">ein Datensatz darin ist abgeschnitten</translation>
        </message>
        <message>
            <source>a chunk is compressed by {chunk_compression!r}, not zstd</source>
            <translation type="unfinished">ein Abschnitt ist mit {chunk_compression!r} komprimiert, nicht mit zstd</translation>
        </message>
        <message>
            <source>a chunk does not hold the {size} bytes that it says</source>
            <translation type="unfinished">ein Abschnitt enthält nicht die {size} Byte, die er angibt</translation>
        </message>
        <message>
            <source>its crc is another</source>
            <translation type="unfinished">seine CRC ist eine andere</translation>
        </message>
        <message>
            <source>{path_name} is not an MCAP file: it begins with {first_bytes}</source>
            <translation type="unfinished">{path_name} ist keine MCAP-Datei: Sie beginnt mit {first_bytes}</translation>
        </message>
        <message>
            <source>the record at byte {offset} is damaged and left out: {fault}</source>
            <translation type="unfinished">der Datensatz bei Byte {offset} ist beschädigt und wird ausgelassen: {fault}</translation>
        </message>
        <message>
            <source>no sample of this attempt has a direction of the needle</source>
            <translation type="unfinished">kein Abtastwert dieses Versuchs hat eine Richtung der Nadel</translation>
        </message>
        <message>
            <source>depth not measured{reason}</source>
            <translation type="unfinished">Tiefe nicht gemessen{reason}</translation>
        </message>
        <message>
            <source>depth not measured{reason}: it may be anywhere from {low:.0f} to {high:.0f} mm, and the force is held back for the worst of it</source>
            <translation type="unfinished">Tiefe nicht gemessen{reason}: Sie kann überall zwischen {low:.0f} und {high:.0f} mm liegen, und die Kraft ist für den ungünstigsten Fall gedrosselt</translation>
        </message>
        <message>
            <source>the needle bends: its tip is {pose_deflection:.1f} mm off its line</source>
            <translation type="unfinished">die Nadel biegt sich: Ihre Spitze liegt {pose_deflection:.1f} mm neben ihrer Linie</translation>
        </message>
        <message>
            <source>depth from one camera and the needle's line: less exact</source>
            <translation type="unfinished">Tiefe aus einer Kamera und der Linie der Nadel: weniger genau</translation>
        </message>
        <message>
            <source>depth held for {pose_depth_age:.0f} ms</source>
            <translation type="unfinished">Tiefe seit {pose_depth_age:.0f} ms gehalten</translation>
        </message>
        <message>
            <source>{recording_lost_rows} ticks of the loop were not recorded</source>
            <translation type="unfinished">nicht aufgezeichnete Takte der Regelschleife: {recording_lost_rows}</translation>
        </message>
        <message>
            <source>the station's key {path} cannot be used: {error_strerror}; attempts stay unsigned until it can be read</source>
            <translation type="unfinished">der Schlüssel {path} der Station ist nicht verwendbar: {error_strerror}; Versuche bleiben unsigniert, bis er gelesen werden kann</translation>
        </message>
        <message>
            <source>the station's key {path} is damaged: bring it back with `acus store restore` and the recovery key, or move it away for a new one</source>
            <translation type="unfinished">der Schlüssel {path} der Station ist beschädigt: Holen Sie ihn mit `acus store restore` und dem Wiederherstellungsschlüssel zurück, oder legen Sie ihn für einen neuen beiseite</translation>
        </message>
        <message>
            <source>the station's key in this backup was sealed by an earlier build, in a form that is no longer read: change the password where it was made (`acus people instructor`), which prints a new recovery key, and make the backup again; or restore it without `--key`, and admit its attempts</source>
            <translation type="unfinished">der Schlüssel der Station in dieser Sicherung wurde von einer früheren Fassung versiegelt, in einer Form, die nicht mehr gelesen wird: Ändern Sie das Passwort dort, wo sie erstellt wurde (`acus people instructor`), das druckt einen neuen Wiederherstellungsschlüssel, und erstellen Sie die Sicherung neu; oder stellen Sie sie ohne `--key` wieder her und erkennen Sie ihre Versuche an</translation>
        </message>
        <message>
            <source>a nonce of {nonce_bytes} bytes</source>
            <translation type="unfinished">eine Nonce von {nonce_bytes} Byte</translation>
        </message>
        <message>
            <source>the station's key in this backup is damaged</source>
            <translation type="unfinished">der Schlüssel der Station in dieser Sicherung ist beschädigt</translation>
        </message>
        <message>
            <source>that is not the recovery key that was printed: type it again</source>
            <translation type="unfinished">das ist nicht der gedruckte Wiederherstellungsschlüssel: Geben Sie ihn noch einmal ein</translation>
        </message>
        <message>
            <source>a recovery key has eight groups of four letters and digits: type it again</source>
            <translation type="unfinished">ein Wiederherstellungsschlüssel hat acht Gruppen aus vier Buchstaben und Ziffern: Geben Sie ihn noch einmal ein</translation>
        </message>
        <message>
            <source>{session_id!r} {trouble} in {folder}: `acus session list` says which there are</source>
            <translation type="unfinished">{session_id!r} {trouble} in {folder}: `acus session list` sagt, welche es gibt</translation>
        </message>
        <message>
            <source>{folder} holds {count} records: give the file of one of them</source>
            <translation type="unfinished">Aufzeichnungen in {folder}: {count}; geben Sie die Datei einer davon an</translation>
        </message>
        <message>
            <source>{path_stem} is being recorded: end its attempt first, or wait 10 s</source>
            <translation type="unfinished">{path_stem} wird gerade aufgezeichnet: Beenden Sie zuerst den Versuch, oder warten Sie 10 s</translation>
        </message>
        <message>
            <source>{chosen} is not a folder: give the folder that holds the records</source>
            <translation type="unfinished">{chosen} ist kein Ordner: Geben Sie den Ordner mit den Aufzeichnungen an</translation>
        </message>
        <message>
            <source>cannot read the folder {folder}: {error_strerror}</source>
            <translation type="unfinished">der Ordner {folder} lässt sich nicht lesen: {error_strerror}</translation>
        </message>
        <message>
            <source>{target} exists already: move it away first</source>
            <translation type="unfinished">{target} gibt es schon: Legen Sie das zuerst beiseite</translation>
        </message>
        <message>
            <source>cannot move {path} to {to}: {reason}</source>
            <translation type="unfinished">{path} lässt sich nicht nach {to} verschieben: {reason}</translation>
        </message>
        <message>
            <source>version {version!r}; only {known_version} is known</source>
            <translation type="unfinished">Version {version!r}; bekannt ist nur {known_version}</translation>
        </message>
        <message>
            <source>not a stored score</source>
            <translation type="unfinished">keine gespeicherte Bewertung</translation>
        </message>
        <message>
            <source>this computer was too slow by {seconds:.0f} s: robot, cameras and hand were slowed with it, and the score is what it would have been</source>
            <translation type="unfinished">dieser Computer war um {seconds:.0f} s zu langsam: Roboter, Kameras und Hand wurden mitverlangsamt, und die Bewertung ist, was sie sonst auch wäre</translation>
        </message>
        <message>
            <source>the computer or the program slept for {seconds:.1f} s: what the needle did meanwhile is not known</source>
            <translation type="unfinished">der Computer oder das Programm schlief {seconds:.1f} s lang: Was die Nadel in dieser Zeit tat, ist nicht bekannt</translation>
        </message>
        <message>
            <source>no slot {name!r} in this record; it has {columns}</source>
            <translation type="unfinished">kein Platz {name!r} in dieser Aufzeichnung; sie hat {columns}</translation>
        </message>
        <message>
            <source>only {usable} of {seen} fixes could be used, {fewest} are needed: keep the marker in both pictures and hold still</source>
            <translation type="unfinished">nur {usable} von {seen} Messungen waren verwendbar, nötig sind {fewest}: Halten Sie den Marker in beiden Bildern und halten Sie still</translation>
        </message>
        <message>
            <source>the tip moved by {spread_mm:.1f} mm while it was measured: rest it in the mark and hold still for a second</source>
            <translation type="unfinished">die Spitze bewegte sich während der Messung um {spread_mm:.1f} mm: Setzen Sie sie in die Marke und halten Sie eine Sekunde still</translation>
        </message>
        <message>
            <source>nobody can take the needle over while {running_attempt_state}: no attempt is running</source>
            <translation type="unfinished">im Zustand {running_attempt_state} kann niemand die Nadel übernehmen: Es läuft kein Versuch</translation>
        </message>
        <message>
            <source>exercise {exercise_id} keeps the assistance at {dial:g}; it can be turned in exercises that do not lock it</source>
            <translation type="unfinished">die Übung {exercise_id} hält die Unterstützung auf {dial:g}; verstellen lässt sie sich in Übungen, die sie nicht sperren</translation>
        </message>
        <message>
            <source>exercise {exercise_id} keeps the models by which its effects are computed; they can be chosen in exercises that do not lock them</source>
            <translation type="unfinished">die Übung {exercise_id} behält die Modelle, mit denen ihre Effekte berechnet werden; wählen lassen sie sich in Übungen, die sie nicht sperren</translation>
        </message>
        <message>
            <source>the patient of exercise {exercise_id} does not hold the breath on command; breathing with `model: on_command` does</source>
            <translation type="unfinished">der Patient der Übung {exercise_id} hält den Atem nicht auf Kommando an; eine Atmung mit `model: on_command` tut das</translation>
        </message>
        <message>
            <source>pseudonym or PIN is wrong</source>
            <translation type="unfinished">Pseudonym oder PIN ist falsch</translation>
        </message>
        <message>
            <source>{error}; until then wrong tries are not kept</source>
            <translation type="unfinished">{error}; bis dahin werden falsche Eingaben nicht gespeichert</translation>
        </message>
        <message>
            <source>too many wrong tries: wait {early:.0f} s, then try again</source>
            <translation type="unfinished">zu viele falsche Eingaben: Warten Sie {early:.0f} s und versuchen Sie es dann noch einmal</translation>
        </message>
        <message>
            <source>: wait {wait:.0f} s before the next try</source>
            <translation type="unfinished">: Warten Sie {wait:.0f} s bis zur nächsten Eingabe</translation>
        </message>
        <message>
            <source>the password is wrong</source>
            <translation type="unfinished">das Passwort ist falsch</translation>
        </message>
        <message>
            <source>{quantity}: {written} written, {recomputed} by the record</source>
            <translation type="unfinished">{quantity}: geschrieben {written}, laut Aufzeichnung {recomputed}</translation>
        </message>
        <message>
            <source>the score cannot be computed again: not all samples are in the record</source>
            <translation type="unfinished">die Bewertung lässt sich nicht neu berechnen: Es sind nicht alle Abtastwerte in der Aufzeichnung</translation>
        </message>
        <message>
            <source>scored by version {written_version}: {points}, by today's rules: {now}</source>
            <translation type="unfinished">bewertet nach Version {written_version}: {points}, nach heutigen Regeln: {now}</translation>
        </message>
        <message>
            <source>the score in this record is not what its samples give: {most}{more}</source>
            <translation type="unfinished">die Bewertung in dieser Aufzeichnung entspricht nicht ihren Abtastwerten: {most}{more}</translation>
        </message>
        <message>
            <source>the attempt was not finished: it has no score to verify</source>
            <translation type="unfinished">der Versuch wurde nicht beendet: Es gibt keine Bewertung zu prüfen</translation>
        </message>
        <message>
            <source>this program has the rules of versions {versions}</source>
            <translation type="unfinished">dieses Programm hat die Regeln der Versionen {versions}</translation>
        </message>
        <message>
            <source>it cannot be checked: {known}</source>
            <translation type="unfinished">sie lässt sich nicht prüfen: {known}</translation>
        </message>
        <message>
            <source>not scored, as written: {unscored}</source>
            <translation type="unfinished">nicht bewertet, wie geschrieben: {unscored}</translation>
        </message>
        <message>
            <source>the cameras saw the tip {pose_depth_mm:.0f} mm inside the skin {now:.1f} s after you said that the needle is out; withdraw it and begin again</source>
            <translation type="unfinished">die Kameras sahen die Spitze {pose_depth_mm:.0f} mm innerhalb der Haut, {now:.1f} s nachdem Sie sagten, dass die Nadel draußen ist; ziehen Sie sie heraus und beginnen Sie noch einmal</translation>
        </message>
        <message>
            <source>the field has {tissues} tissues and {rows} rows of values; give one for each code</source>
            <translation type="unfinished">das Feld hat {tissues} Gewebe und {rows} Zeilen mit Werten; geben Sie für jeden Code eine an</translation>
        </message>
        <message>
            <source>device {name!r} renders {unknown_axis!r}; known axes are {device_axes}</source>
            <translation type="unfinished">das Gerät {name!r} gibt {unknown_axis!r} wieder; bekannte Achsen sind {device_axes}</translation>
        </message>
        <message>
            <source>effect {name!r} has no model {asked!r}; it has {models}</source>
            <translation type="unfinished">der Effekt {name!r} hat kein Modell {asked!r}; er hat {models}</translation>
        </message>
        <message>
            <source>{declared_path}: parameters() gives an array of the shape {array_shape} for this scene and these values; give one of the shape (n,), and of {least} numbers at least, as it was tried</source>
            <translation type="unfinished">{declared_path}: parameters() liefert für diese Szene und diese Werte ein Array der Form {array_shape}; liefern Sie eines der Form (n,) mit mindestens {least} Zahlen, wie es erprobt wurde</translation>
        </message>
        <message>
            <source>{effect_path}: step is not compiled; put @stage of core.compiled before it</source>
            <translation type="unfinished">{effect_path}: step ist nicht kompiliert; setzen Sie @stage aus core.compiled davor</translation>
        </message>
        <message>
            <source>{effect_path}: pictures is True; only the program's own effects act on pictures</source>
            <translation type="unfinished">{effect_path}: pictures ist True; nur die eigenen Effekte des Programms wirken auf Bilder</translation>
        </message>
        <message>
            <source>joint {joint!r} is none of the two that are known ({names}); it is taken as redesigned: give design 1 for printed, or 2</source>
            <translation type="unfinished">das Gelenk {joint!r} ist keines der beiden bekannten ({names}); es gilt als neu konstruiert: Geben Sie design 1 für gedruckt an oder 2</translation>
        </message>
        <message>
            <source>the robot's own joints are felt beside it</source>
            <translation type="unfinished">die eigenen Gelenke des Roboters sind daneben zu spüren</translation>
        </message>
        <message>
            <source>model {binding_model} changes sign with every encoder count, a tilt of {count:g} mrad; kikuuwe does not</source>
            <translation type="unfinished">das Modell {binding_model} wechselt mit jedem Encoderschritt das Vorzeichen, das sind {count:g} mrad Neigung; kikuuwe nicht</translation>
        </message>
        <message>
            <source>presliding_angle {presliding_angle:g} rad is less than an encoder count of {count:g} rad: a still hand feels the force change sign; give {count:g} rad or more</source>
            <translation type="unfinished">presliding_angle {presliding_angle:g} rad ist kleiner als ein Encoderschritt von {count:g} rad: Eine ruhende Hand spürt, wie die Kraft das Vorzeichen wechselt; geben Sie {count:g} rad oder mehr an</translation>
        </message>
        <message>
            <source>the layers are {thickness:g} m thick together; at most {longest:g} m</source>
            <translation type="unfinished">die Gewebeschichten sind zusammen {thickness:g} m dick; höchstens {longest:g} m</translation>
        </message>
        <message>
            <source>puncture by rate relaxes its dimple itself: this adds to the force that a membrane tears at; take the model standing</source>
            <translation type="unfinished">puncture mit rate entspannt seine Eindellung selbst: Dies kommt zu der Kraft hinzu, bei der eine Membran reißt; nehmen Sie das Modell standing</translation>
        </message>
        <message>
            <source>the dimple does not relax: puncture by rate would, and its model is another</source>
            <translation type="unfinished">die Eindellung entspannt sich nicht: puncture mit rate täte es, hat hier aber ein anderes Modell</translation>
        </message>
        <message>
            <source>model {binding_model} changes sign with every count of a measured depth, here {count:g} µm; kikuuwe does not</source>
            <translation type="unfinished">das Modell {binding_model} wechselt mit jedem Schritt einer gemessenen Tiefe das Vorzeichen, hier {count:g} µm; kikuuwe nicht</translation>
        </message>
        <message>
            <source>presliding_stiffness {presliding_stiffness:g} N/m² times a count of {count:g} µm is more than the friction of {friction:g} N/m: a still hand feels it change sign with every count; give {largest_stiffness:g} N/m² or less</source>
            <translation type="unfinished">presliding_stiffness {presliding_stiffness:g} N/m² mal einem Schritt von {count:g} µm ist mehr als die Reibung von {friction:g} N/m: Eine ruhende Hand spürt bei jedem Schritt einen Vorzeichenwechsel; geben Sie {largest_stiffness:g} N/m² oder weniger an</translation>
        </message>
        <message>
            <source>the scene's field is a {type_name}; bind it first</source>
            <translation type="unfinished">das Feld der Szene ist ein {type_name}; binden Sie es zuerst</translation>
        </message>
        <message>
            <source>there is no hand {name!r}; there are {hands}</source>
            <translation type="unfinished">es gibt keine Hand {name!r}; vorhanden sind {hands}</translation>
        </message>
        <message>
            <source>the target lies at depth {depth} m; it must be above 0</source>
            <translation type="unfinished">das Ziel liegt in der Tiefe {depth} m; sie muss größer als 0 sein</translation>
        </message>
        <message>
            <source>effect {stored_name}: energy_bound is {bound} J; give a finite number of 0 or more</source>
            <translation type="unfinished">Effekt {stored_name}: energy_bound ist {bound} J; geben Sie eine endliche Zahl von mindestens 0 an</translation>
        </message>
        <message>
            <source>dropped: it needs {need}, and the scene has none</source>
            <translation type="unfinished">entfällt: Er braucht {need}, und die Szene hat das nicht</translation>
        </message>
        <message>
            <source>dropped: it acts on {request_organ}, and the target lies in {scene_target_organ}</source>
            <translation type="unfinished">entfällt: Er wirkt auf {request_organ}, und das Ziel liegt in {scene_target_organ}</translation>
        </message>
        <message>
            <source>effect {name} builds on it</source>
            <translation type="unfinished">der Effekt {name} baut darauf auf</translation>
        </message>
        <message>
            <source>simulated: it gives {in_words}; {consumers}</source>
            <translation type="unfinished">simuliert: Er liefert {in_words}; {consumers}</translation>
        </message>
        <message>
            <source>dropped: it changes the pictures of simulated cameras, and there are none: the cameras are real, and so are their pictures</source>
            <translation type="unfinished">entfällt: Er verändert die Bilder simulierter Kameras, und es gibt keine: Die Kameras sind echt und ihre Bilder auch</translation>
        </message>
        <message>
            <source>dropped: it gives {in_words}, and nobody asks for that: device {device_name} renders {axes} force, and no view that is shown, no metric that is scored and no other effect needs it</source>
            <translation type="unfinished">entfällt: Er liefert {in_words}, und das fragt niemand ab: Das Gerät {device_name} gibt Kraft wieder für: {axes}, und keine gezeigte Ansicht, keine bewertete Messgröße und kein anderer Effekt braucht es</translation>
        </message>
        <message>
            <source>nothing but its own account</source>
            <translation type="unfinished">nichts als seine eigene Bilanz</translation>
        </message>
        <message>
            <source>effects need each other's results in a circle: {circle}; take one of them out</source>
            <translation type="unfinished">Effekte brauchen ihre Ergebnisse gegenseitig im Kreis: {circle}; nehmen Sie einen davon heraus</translation>
        </message>
        <message>
            <source>hand {name} is {setting}; give a finite value of 0 or more</source>
            <translation type="unfinished">Hand: {name} ist {setting}; geben Sie einen endlichen Wert von mindestens 0 an</translation>
        </message>
        <message>
            <source>device {profile_name} cannot hold the needle along {direction}; its tilt limit is {profile_tilt_limit_deg:g} degrees</source>
            <translation type="unfinished">das Gerät {profile_name} kann die Nadel nicht in der Richtung {direction} halten; seine Neigungsgrenze ist {profile_tilt_limit_deg:g} Grad</translation>
        </message>
        <message>
            <source>layer {name!r}: {quantity} is {setting}; give a finite value of 0 or more</source>
            <translation type="unfinished">Gewebeschicht {name!r}: {quantity} ist {setting}; geben Sie einen endlichen Wert von mindestens 0 an</translation>
        </message>
        <message>
            <source>layer {name!r}: moves is {moves}; give a share from 0 to 1, or leave it out</source>
            <translation type="unfinished">Gewebeschicht {name!r}: moves ist {moves}; geben Sie einen Anteil von 0 bis 1 an oder lassen Sie es weg</translation>
        </message>
        <message>
            <source>layer {name!r}: relaxation_share is {relaxation_share} and relaxation_time {relaxation_time}; give 0 to below 1, and above 0 s</source>
            <translation type="unfinished">Gewebeschicht {name!r}: relaxation_share ist {relaxation_share} und relaxation_time {relaxation_time}; geben Sie 0 bis unter 1 und mehr als 0 s an</translation>
        </message>
        <message>
            <source>layer {name!r}: a membrane that is punctured at {puncture_force} N needs an indentation_stiffness or indentation_hardening above 0</source>
            <translation type="unfinished">Gewebeschicht {name!r}: Eine Membran, die bei {puncture_force} N durchstochen wird, braucht indentation_stiffness oder indentation_hardening über 0</translation>
        </message>
        <message>
            <source>layer {below_name!r} lies below {above_name!r}, which is rigid: the needle stops there; let the rigid layer be the last one</source>
            <translation type="unfinished">die Gewebeschicht {below_name!r} liegt unter {above_name!r}, und diese ist starr: Die Nadel hält dort an; die starre Gewebeschicht muss die letzte sein</translation>
        </message>
        <message>
            <source>layer 'skin' lies below {above_name!r}; layers are given from the skin inwards</source>
            <translation type="unfinished">die Gewebeschicht 'skin' liegt unter {above_name!r}; Gewebeschichten werden von der Haut nach innen angegeben</translation>
        </message>
        <message>
            <source>needle {quantity} is {setting}; give a finite value above 0</source>
            <translation type="unfinished">Nadel: {quantity} ist {setting}; geben Sie einen endlichen Wert über 0 an</translation>
        </message>
        <message>
            <source>R_world_patient {rotation} is not a rotation</source>
            <translation type="unfinished">R_world_patient {rotation} ist keine Drehung</translation>
        </message>
        <message>
            <source>the scene has a field of tissue and no values for it; give a row of `tissues` for each of its codes, the first for what nobody labelled</source>
            <translation type="unfinished">die Szene hat ein Gewebefeld und keine Werte dafür; geben Sie für jeden seiner Codes eine Zeile `tissues` an, die erste für das, was niemand beschriftet hat</translation>
        </message>
        <message>
            <source>effect {effect_name!r} stands twice in the scene; name it once</source>
            <translation type="unfinished">der Effekt {effect_name!r} steht zweimal in der Szene; nennen Sie ihn einmal</translation>
        </message>
        <message>
            <source>there is no skill {skill!r}; there are {skills}</source>
            <translation type="unfinished">es gibt keine Könnensstufe {skill!r}; vorhanden sind {skills}</translation>
        </message>
        <message>
            <source>there are no values of tissues called {version!r}; there are {tissues}</source>
            <translation type="unfinished">keine Gewebewerte heißen {version!r}; vorhanden sind {tissues}</translation>
        </message>
        <message>
            <source>the {version} values have no tissue {name!r}; they have {table}</source>
            <translation type="unfinished">die Werte {version} haben kein Gewebe {name!r}; sie haben {table}</translation>
        </message>
        <message>
            <source>targets to be touched lie {depths} m deep; each must lie deeper than their radius of {radius} m</source>
            <translation type="unfinished">die zu berührenden Ziele liegen {depths} m tief; jedes muss tiefer liegen als sein Radius von {radius} m</translation>
        </message>
        <message>
            <source>speed factor is {speed}; give 0.05 to 20</source>
            <translation type="unfinished">der Geschwindigkeitsfaktor ist {speed}; geben Sie 0,05 bis 20 an</translation>
        </message>
        <message>
            <source>a movement to be shown needs two finite samples at least</source>
            <translation type="unfinished">eine Bewegung zum Vorführen braucht mindestens zwei endliche Abtastwerte</translation>
        </message>
        <message>
            <source>{file} cannot be written, so that what is tried would be lost: {error}</source>
            <translation type="unfinished">{file} lässt sich nicht schreiben, sodass verloren ginge, was erprobt wird: {error}</translation>
        </message>
        <message>
            <source>{label}: {current} of {evaluations}, {holes} holes</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>n = {shape:g} is no whole number: the sum has no end</source>
            <translation type="unfinished">n = {shape:g} ist keine ganze Zahl: Die Summe hat kein Ende</translation>
        </message>
        <message>
            <source>squares of {square:g} px</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>SimpleITK, which this study needs,</source>
            <translation type="unfinished">SimpleITK, das diese Studie braucht,</translation>
        </message>
        <message>
            <source>no element can be read</source>
            <translation type="unfinished">kein Element lässt sich lesen</translation>
        </message>
        <message>
            <source>table {name}: two of its headings are alike: {columns}</source>
            <translation type="unfinished">Tabelle {name}: Zwei ihrer Überschriften sind gleich: {columns}</translation>
        </message>
        <message>
            <source>table {name}: a row has {cells} cells, there are {headings} headings: {row}</source>
            <translation type="unfinished">Tabelle {name}: Eine Zeile hat {cells} Zellen, es gibt {headings} Überschriften: {row}</translation>
        </message>
        <message>
            <source>this survey has no measure=...; see 'How to add a study'</source>
            <translation type="unfinished">diese Erhebung hat kein measure=...; siehe „How to add a study“</translation>
        </message>
        <message>
            <source>two hard cases are called {case_name!r}; rename one</source>
            <translation type="unfinished">zwei schwierige Fälle heißen {case_name!r}; benennen Sie einen um</translation>
        </message>
        <message>
            <source>subsystems without a hard case: {bare}</source>
            <translation type="unfinished">Teilsysteme ohne schwierigen Fall: {bare}</translation>
        </message>
        <message>
            <source>{references} has no reference {name!r}; add it to tools/hard_references.py</source>
            <translation type="unfinished">{references} hat keine Referenz {name!r}; ergänzen Sie sie in tools/hard_references.py</translation>
        </message>
        <message>
            <source>hard case {case!r}: subsystem is {subsystem!r}; there are {subsystems}</source>
            <translation type="unfinished">schwieriger Fall {case!r}: subsystem ist {subsystem!r}; vorhanden sind {subsystems}</translation>
        </message>
        <message>
            <source>hard case {case!r} has no reference; use digits() or analytic()</source>
            <translation type="unfinished">der schwierige Fall {case!r} hat keine Referenz; verwenden Sie digits() oder analytic()</translation>
        </message>
        <message>
            <source>hard case {case!r}: bound is {bound}; give 0 or more</source>
            <translation type="unfinished">schwieriger Fall {case!r}: bound ist {bound}; geben Sie 0 oder mehr an</translation>
        </message>
        <message>
            <source>hard case {case!r}: {name} is empty; say it in words</source>
            <translation type="unfinished">schwieriger Fall {case!r}: {name} ist leer; sagen Sie es in Worten</translation>
        </message>
        <message>
            <source>hard case {case!r}: {computed} values found, the reference has {expected}</source>
            <translation type="unfinished">schwieriger Fall {case!r}: {computed} Werte gefunden, die Referenz hat {expected}</translation>
        </message>
        <message>
            <source>{function_qualname} does not call {name}</source>
            <translation type="unfinished">{function_qualname} ruft {name} nicht auf</translation>
        </message>
        <message>
            <source>{caller!r} has no default for {parameter}</source>
            <translation type="unfinished">{caller!r} hat keinen Standardwert für {parameter}</translation>
        </message>
        <message>
            <source>no table of study {name!r} is kept; there are {names}</source>
            <translation type="unfinished">von der Studie {name!r} ist keine Tabelle gespeichert; vorhanden sind {names}</translation>
        </message>
        <message>
            <source>{path} is no table of a study ({error_name}: {error}); write it anew with: acus study NAME --write</source>
            <translation type="unfinished">{path} ist keine Tabelle einer Studie ({error_name}: {error}); schreiben Sie sie neu mit: acus study NAME --write</translation>
        </message>
        <message>
            <source>a kept table cannot be measured again; run the study of its name</source>
            <translation type="unfinished">eine gespeicherte Tabelle lässt sich nicht neu messen; führen Sie die Studie ihres Namens aus</translation>
        </message>
        <message>
            <source>a beam needs k &gt; 0, EI &gt; 0 and depth &gt;= 0; given k = {k}, EI = {ei}, depth = {depth}</source>
            <translation type="unfinished">ein Balken braucht k &gt; 0, EI &gt; 0 und depth &gt;= 0; angegeben sind k = {k}, EI = {ei}, depth = {depth}</translation>
        </message>
        <message>
            <source>{name}, {depth:g} mm</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>limits of {name}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>unreachable: the ball joint stops at {profile_tilt_limit_deg:g}° of tilt</source>
            <translation type="unfinished">unerreichbar: Das Kugelgelenk hält bei {profile_tilt_limit_deg:g}° Neigung an</translation>
        </message>
        <message>
            <source>reach and cost</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>by tilt</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>camera {model_name} has no picture of a band at {p_camera} m</source>
            <translation type="unfinished">die Kamera {model_name} hat kein Bild eines Bandes bei {p_camera} m</translation>
        </message>
        <message>
            <source>camera {model_name} does not see the band at {scene_p_world}</source>
            <translation type="unfinished">die Kamera {model_name} sieht das Band bei {scene_p_world} nicht</translation>
        </message>
        <message>
            <source>cube of {edge_mm:g} mm</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>trials</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>cannot write the picture {path}: {error}</source>
            <translation type="unfinished">das Bild {path} lässt sich nicht schreiben: {error}</translation>
        </message>
        <message>
            <source>{path} has no list `cases`</source>
            <translation type="unfinished">{path} hat keine Liste `cases`</translation>
        </message>
        <message>
            <source>{path}: two cases are called {case_name!r}; rename one</source>
            <translation type="unfinished">{path}: Zwei Fälle heißen {case_name!r}; benennen Sie einen um</translation>
        </message>
        <message>
            <source>{where} is {row!r}; give {wanted}</source>
            <translation type="unfinished">{where} ist {row!r}; geben Sie {wanted} an</translation>
        </message>
        <message>
            <source>{where}: check {key!r}; there must be {wanted}, and may be {may}</source>
            <translation type="unfinished">{where}: Prüfen Sie {key!r}; da sein müssen {wanted}, da sein dürfen {may}</translation>
        </message>
        <message>
            <source>{where}: {key} is {row!r}</source>
            <translation type="unfinished">{where}: {key} ist {row!r}</translation>
        </message>
        <message>
            <source>{where}: range is {ends!r}; give [least, most], finite numbers</source>
            <translation type="unfinished">{where}: range ist {ends!r}; geben Sie [kleinster, größter] an, endliche Zahlen</translation>
        </message>
        <message>
            <source>{where}: {measured:g} {unit} was measured, and the range {least:g} to {largest:g} excludes it; give the range that holds it</source>
            <translation type="unfinished">{where}: Gemessen wurden {measured:g} {unit}, und der Bereich {least:g} bis {largest:g} schließt das aus; geben Sie den Bereich an, der es enthält</translation>
        </message>
        <message>
            <source>{where}: {quantity} is {entry!r}; there are {valid}</source>
            <translation type="unfinished">{where}: {quantity} ist {entry!r}; vorhanden sind {valid}</translation>
        </message>
        <message>
            <source>{where} is not chosen; say in `choice` why</source>
            <translation type="unfinished">{where} ist nicht gewählt; sagen Sie in `choice`, warum</translation>
        </message>
        <message>
            <source>device {profile_name}: tool_mass is {profile_inertia_tool_mass} kg; MuJoCo needs a positive one</source>
            <translation type="unfinished">Gerät {profile_name}: tool_mass ist {profile_inertia_tool_mass} kg; MuJoCo braucht eine positive Masse</translation>
        </message>
        <message>
            <source>MuJoCo refuses the model of device {profile_name}: {error}</source>
            <translation type="unfinished">MuJoCo lehnt das Modell des Geräts {profile_name} ab: {error}</translation>
        </message>
        <message>
            <source>MuJoCo's model of {profile_name} still moves at {speed:.2g} rad/s after 0.4 s; the torques {torques} N·m may be too large</source>
            <translation type="unfinished">das MuJoCo-Modell von {profile_name} bewegt sich nach 0,4 s noch mit {speed:.2g} rad/s; die Drehmomente {torques} N·m sind vielleicht zu groß</translation>
        </message>
        <message>
            <source>tilt is {tilt} rad; a cone needs more than 0 and less than π/2</source>
            <translation type="unfinished">die Neigung ist {tilt} rad; ein Kegel braucht mehr als 0 und weniger als π/2</translation>
        </message>
        <message>
            <source>no tool point within {tilt_deg:g}° of tilt is reached in mode {mode}, assembly {assembly}</source>
            <translation type="unfinished">kein Werkzeugpunkt innerhalb von {tilt_deg:g}° Neigung wird im Modus {mode}, Montage {assembly}, erreicht</translation>
        </message>
        <message>
            <source>L_out is {l_out} m and tilt {tilt} rad; L_out must be above 0, tilt in [0, π/2)</source>
            <translation type="unfinished">L_out ist {l_out} m und die Neigung {tilt} rad; L_out muss größer als 0 sein, die Neigung in [0, π/2) liegen</translation>
        </message>
        <message>
            <source>study file {declared_path} must define STUDY, a Study or Survey of {name!r}</source>
            <translation type="unfinished">die Studiendatei {declared_path} muss STUDY definieren, eine Study oder Survey namens {name!r}</translation>
        </message>
        <message>
            <source>study {chosen_name} has no ways to time; examine() runs a survey</source>
            <translation type="unfinished">die Studie {chosen_name} hat keine Verfahren, deren Zeit zu messen wäre; examine() führt eine Erhebung aus</translation>
        </message>
        <message>
            <source>{name}: {name_of_all}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>study {chosen_name} compares ways by time; run() runs it</source>
            <translation type="unfinished">die Studie {chosen_name} vergleicht Verfahren nach ihrer Zeit; run() führt sie aus</translation>
        </message>
        <message>
            <source>study {chosen_name} takes no folders; leave {folder} out</source>
            <translation type="unfinished">die Studie {chosen_name} nimmt keine Ordner; lassen Sie {folder} weg</translation>
        </message>
        <message>
            <source>study {chosen_name} needs {chosen_borrows} from a room above; run it by: acus study {chosen_name}</source>
            <translation type="unfinished">die Studie {chosen_name} braucht {chosen_borrows} aus einem höheren Raum; starten Sie sie mit: acus study {chosen_name}</translation>
        </message>
        <message>
            <source>its result is not finite (error {error})</source>
            <translation type="unfinished">ihr Ergebnis ist nicht endlich (Fehler {error})</translation>
        </message>
        <message>
            <source>{rate:g} Hz, {delay} ticks</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>no ray of camera {model_name} for {pixels}</source>
            <translation type="unfinished">kein Sehstrahl der Kamera {model_name} für {pixels}</translation>
        </message>
        <message>
            <source>study {name}: each {kind} needs a name of its own: {names}</source>
            <translation type="unfinished">Studie {name}: Jedes Element ({kind}) braucht einen eigenen Namen: {names}</translation>
        </message>
        <message>
            <source>study {name}: its default {default!r} is no way; there are {ways}</source>
            <translation type="unfinished">Studie {name}: Ihr Standard {default!r} ist kein Verfahren; vorhanden sind {ways}</translation>
        </message>
        <message>
            <source>{picture} has {w}x{h} pixels; camera {camera_name} was calibrated at {cw}x{ch}: set the camera to that size, or calibrate at the new one</source>
            <translation type="unfinished">{picture} hat {w}x{h} Pixel; die Kamera {camera_name} wurde bei {cw}x{ch} kalibriert: Stellen Sie die Kamera auf diese Größe ein, oder kalibrieren Sie bei der neuen</translation>
        </message>
        <message>
            <source>the cameras are swapped: calibration {calibration_id} has {left_camera} on the left and {right_camera} on the right; exchange the two sources</source>
            <translation type="unfinished">die Kameras sind vertauscht: Die Kalibrierung {calibration_id} hat links {left_camera} und rechts {right_camera}; tauschen Sie die beiden Quellen</translation>
        </message>
        <message>
            <source>calibration {calibration_id} is of the cameras {known}; in use are {names}: use their calibration, or calibrate them</source>
            <translation type="unfinished">die Kalibrierung {calibration_id} gehört zu den Kameras {known}; in Gebrauch sind {names}: Verwenden Sie deren Kalibrierung, oder kalibrieren Sie sie</translation>
        </message>
        <message>
            <source>no paper is called {name!r}; there are {papers}</source>
            <translation type="unfinished">kein Papier heißt {name!r}; vorhanden sind {papers}</translation>
        </message>
        <message>
            <source>board {board_spec} measures {width:.0f} x {height:.0f} mm and does not fit on {paper_name}; squares of at most {largest_square:.4g} mm would</source>
            <translation type="unfinished">die Tafel {board_spec} misst {width:.0f} x {height:.0f} mm und passt nicht auf {paper_name}; Quadrate von höchstens {largest_square:.4g} mm würden passen</translation>
        </message>
        <message>
            <source>, or take {others}</source>
            <translation type="unfinished">, oder nehmen Sie {others}</translation>
        </message>
        <message>
            <source>no picture shows the board: take one with all of it in view</source>
            <translation type="unfinished">kein Bild zeigt die Tafel: Machen Sie eines, auf dem sie ganz zu sehen ist</translation>
        </message>
        <message>
            <source>no place in front of the cameras explains the corners; are the pictures of these cameras, left and right not exchanged?</source>
            <translation type="unfinished">kein Ort vor den Kameras erklärt die Ecken; sind die Bilder von diesen Kameras, links und rechts nicht vertauscht?</translation>
        </message>
        <message>
            <source>checkerboard:COLSxROWS:SQUARE (inner corners, e.g. checkerboard:9x6:25mm) or charuco:COLSxROWS:SQUARE:MARKER:DICTIONARY (squares, e.g. {example})</source>
            <translation type="unfinished">checkerboard:COLSxROWS:SQUARE (innere Ecken, z. B. checkerboard:9x6:25mm) oder charuco:COLSxROWS:SQUARE:MARKER:DICTIONARY (Quadrate, z. B. {example})</translation>
        </message>
        <message>
            <source>a board with {columns}x{rows} inner corners cannot be used; at least 2x2 and at most 100x100 are needed</source>
            <translation type="unfinished">eine Tafel mit {columns}x{rows} inneren Ecken ist nicht verwendbar; nötig sind mindestens 2x2 und höchstens 100x100</translation>
        </message>
        <message>
            <source>a square of {square:g} mm cannot be used; 0.1 mm to 1 m are possible</source>
            <translation type="unfinished">ein Quadrat von {square:g} mm ist nicht verwendbar; möglich sind 0,1 mm bis 1 m</translation>
        </message>
        <message>
            <source>board {spec!r} is not {forms}</source>
            <translation type="unfinished">die Tafel {spec!r} ist nicht {forms}</translation>
        </message>
        <message>
            <source>no marker dictionary is called {board_dictionary!r}; there are {names}</source>
            <translation type="unfinished">kein Marker-Wörterbuch heißt {board_dictionary!r}; vorhanden sind {names}</translation>
        </message>
        <message>
            <source>a marker of {board_marker:g} mm does not fit into a square of {board_square:g} mm; it must be smaller</source>
            <translation type="unfinished">ein Marker von {board_marker:g} mm passt nicht in ein Quadrat von {board_square:g} mm; er muss kleiner sein</translation>
        </message>
        <message>
            <source>board {board_spec} needs {needed} markers; {board_dictionary} has {dictionary_size}; take a larger dictionary</source>
            <translation type="unfinished">die Tafel {board_spec} braucht {needed} Marker; {board_dictionary} hat {dictionary_size}; nehmen Sie ein größeres Wörterbuch</translation>
        </message>
        <message>
            <source>board {spec!r}: {size!r} is not COLSxROWS, e.g. 9x6</source>
            <translation type="unfinished">Tafel {spec!r}: {size!r} ist nicht COLSxROWS, z. B. 9x6</translation>
        </message>
        <message>
            <source>board {spec!r}: {length!r} is not a length with its unit; write e.g. 25mm, 2.5cm or 0.025m</source>
            <translation type="unfinished">Tafel {spec!r}: {length!r} ist keine Länge mit Einheit; schreiben Sie z. B. 25mm, 2.5cm oder 0.025m</translation>
        </message>
        <message>
            <source>the first estimate puts a board behind a camera</source>
            <translation type="unfinished">die erste Schätzung setzt eine Tafel hinter eine Kamera</translation>
        </message>
        <message>
            <source>adjusting</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{measured} pixel coordinates cannot determine {unknown} unknowns; add views</source>
            <translation type="unfinished">{measured} Pixelkoordinaten können {unknown} Unbekannte nicht bestimmen; nehmen Sie mehr auf</translation>
        </message>
        <message>
            <source>the views do not determine where a board was; tilt the board to different sides by 20 to 45 degrees</source>
            <translation type="unfinished">die Aufnahmen bestimmen nicht, wo eine Tafel war; neigen Sie die Tafel um 20 bis 45 Grad nach verschiedenen Seiten</translation>
        </message>
        <message>
            <source>{points} are {measured:.4g} mm apart, {known:.4g} mm known ({ratio:+.1%})</source>
            <translation type="unfinished">{points} liegen {measured:.4g} mm auseinander, bekannt sind {known:.4g} mm ({ratio:+.1%})</translation>
        </message>
        <message>
            <source>: more than {limit:.0%}; measure the board: squares of {fitting_mm:.4g} mm instead of {stated_mm:g} mm would explain it</source>
            <translation type="unfinished">: mehr als {limit:.0%}; messen Sie die Tafel nach: Quadrate von {fitting_mm:.4g} mm statt {stated_mm:g} mm würden es erklären</translation>
        </message>
        <message>
            <source>hold the board nearer to the camera, and farther away</source>
            <translation type="unfinished">halten Sie die Tafel näher an die Kamera und weiter weg</translation>
        </message>
        <message>
            <source>{count} more pictures of the board, unlike those taken</source>
            <translation type="unfinished">weitere Bilder der Tafel, anders als die gemachten: {count}</translation>
        </message>
        <message>
            <source>{corner} corner of the picture not covered</source>
            <translation type="unfinished">Ecke des Bildes nicht abgedeckt: {corner}</translation>
        </message>
        <message>
            <source>, nothing near the {corner} corner</source>
            <translation type="unfinished">, nichts nahe der Ecke: {corner}</translation>
        </message>
        <message>
            <source>{share} % of the picture covered, {wanted} % wanted{where}</source>
            <translation type="unfinished">{share} % des Bildes abgedeckt, gewünscht sind {wanted} %{where}</translation>
        </message>
        <message>
            <source>tilt the board more: once its {first}, once its {second} side nearer</source>
            <translation type="unfinished">neigen Sie die Tafel stärker, mal mit dieser Seite näher: {first}, mal mit dieser: {second}</translation>
        </message>
        <message>
            <source>tilt the board more: its {second} side towards the camera</source>
            <translation type="unfinished">neigen Sie die Tafel stärker, diese Seite zur Kamera: {second}</translation>
        </message>
        <message>
            <source>tilt the board more: its {first} side towards the camera</source>
            <translation type="unfinished">neigen Sie die Tafel stärker, diese Seite zur Kamera: {first}</translation>
        </message>
        <message>
            <source>{cameras} cameras were named; one or two can be calibrated</source>
            <translation type="unfinished">{cameras} Kameras wurden genannt; kalibrieren lassen sich eine oder zwei</translation>
        </message>
        <message>
            <source>{pictures} pictures were given; there are {cameras} cameras: {names}</source>
            <translation type="unfinished">Bilder: {pictures}, Kameras: {cameras} ({names})</translation>
        </message>
        <message>
            <source>like one already kept: {next}</source>
            <translation type="unfinished">wie ein schon behaltenes: {next}</translation>
        </message>
        <message>
            <source>hold the board still</source>
            <translation type="unfinished">halten Sie die Tafel still</translation>
        </message>
        <message>
            <source>{names}: blurred, edges {view_sharpness:.1f} px wide (at most {limit:.1f}): more light, hold still, focus</source>
            <translation type="unfinished">{names}: unscharf, Kanten {view_sharpness:.1f} px breit (höchstens {limit:.1f}): mehr Licht, still halten, scharf stellen</translation>
        </message>
        <message>
            <source>there are enough views</source>
            <translation type="unfinished">es gibt genug Aufnahmen</translation>
        </message>
        <message>
            <source>the board looks the same after half a turn (both corner counts odd, or both even), and the pairs do not tell which way round it lies ({scores:.1f} px one way, {second:.1f} px the other): take pictures of it in more places and tilts, or use a ChArUco board or one with an odd and an even count</source>
            <translation type="unfinished">die Tafel sieht nach einer halben Drehung gleich aus (beide Eckenzahlen ungerade oder beide gerade), und die Paare verraten nicht, wie herum sie liegt ({scores:.1f} px so herum, {second:.1f} px anders herum): Nehmen Sie sie an mehr Orten und in mehr Neigungen auf, oder verwenden Sie eine ChArUco-Tafel oder eine mit einer ungeraden und einer geraden Zahl</translation>
        </message>
        <message>
            <source>an array of {image_dtype} and shape {shape} is no picture; 8 or 16 bit, grey or BGR, at least 16x16 pixels is needed</source>
            <translation type="unfinished">ein Array vom Typ {image_dtype} und der Form {shape} ist kein Bild; nötig sind 8 oder 16 Bit, Grau oder BGR, mindestens 16x16 Pixel</translation>
        </message>
        <message>
            <source>no board with {board_columns}x{board_rows} inner corners is seen as a whole; show all of it with a white rim, or check the counts</source>
            <translation type="unfinished">keine Tafel mit {board_columns}x{board_rows} inneren Ecken ist ganz zu sehen; zeigen Sie sie ganz und mit weißem Rand, oder prüfen Sie die Anzahlen</translation>
        </message>
        <message>
            <source>the picture is mirrored; turn the camera's mirror mode off</source>
            <translation type="unfinished">das Bild ist gespiegelt; schalten Sie die Spiegelung der Kamera aus</translation>
        </message>
        <message>
            <source>only {first_size} corners are seen; {least_corners} are needed</source>
            <translation type="unfinished">nur {first_size} Ecken sind zu sehen; nötig sind {least_corners}</translation>
        </message>
        <message>
            <source>{markers} markers of {board_dictionary} are seen, but they do not lie as on {board_spec}; {counted}</source>
            <translation type="unfinished">{markers} Marker von {board_dictionary} sind zu sehen, liegen aber nicht wie auf {board_spec}; {counted}</translation>
        </message>
        <message>
            <source>no ChArUco board with markers of {board_dictionary} is seen; check the dictionary</source>
            <translation type="unfinished">keine ChArUco-Tafel mit Markern von {board_dictionary} ist zu sehen; prüfen Sie das Wörterbuch</translation>
        </message>
        <message>
            <source>check the counts of squares</source>
            <translation type="unfinished">prüfen Sie die Anzahlen der Quadrate</translation>
        </message>
        <message>
            <source>they fit {larger_spec}: squares are counted, not inner corners</source>
            <translation type="unfinished">sie passen zu {larger_spec}: Gezählt werden Quadrate, nicht innere Ecken</translation>
        </message>
        <message>
            <source>the corners seen lie on one line; show more of the board</source>
            <translation type="unfinished">die sichtbaren Ecken liegen auf einer Linie; zeigen Sie mehr von der Tafel</translation>
        </message>
        <message>
            <source>the board is seen on edge ({tilt_deg:.0f}°); turn it to the camera, up to {largest_tilt_deg:.0f}° are possible</source>
            <translation type="unfinished">die Tafel ist fast von der Kante zu sehen ({tilt_deg:.0f}°); drehen Sie sie zur Kamera, bis zu {largest_tilt_deg:.0f}° sind möglich</translation>
        </message>
        <message>
            <source>a square is only {square_px:.1f} px across; {smallest_square:g} px are needed: bring the board nearer</source>
            <translation type="unfinished">ein Quadrat ist nur {square_px:.1f} px breit; nötig sind {smallest_square:g} px: Bringen Sie die Tafel näher heran</translation>
        </message>
        <message>
            <source>the corners found do not lie on a grid; check the board's counts</source>
            <translation type="unfinished">die gefundenen Ecken liegen nicht auf einem Raster; prüfen Sie die Anzahlen der Tafel</translation>
        </message>
        <message>
            <source>the board has more than {board_columns}x{board_rows} inner corners; count them anew</source>
            <translation type="unfinished">die Tafel hat mehr als {board_columns}x{board_rows} innere Ecken; zählen Sie sie neu</translation>
        </message>
        <message>
            <source>the picture is blurred: edges are {sharpness:.1f} px wide, squares {square_px:.0f} px; hold the board still and focus</source>
            <translation type="unfinished">das Bild ist unscharf: Kanten sind {sharpness:.1f} px breit, Quadrate {square_px:.0f} px; halten Sie die Tafel still und stellen Sie scharf</translation>
        </message>
        <message>
            <source>{together_px:.2f} px against {left_alone_px:.2f} and {right_alone_px:.2f}</source>
            <translation type="unfinished">{together_px:.2f} px gegenüber {left_alone_px:.2f} und {right_alone_px:.2f}</translation>
        </message>
        <message>
            <source>standard deviations are multiplied by {result_sd_factor:.1f}</source>
            <translation type="unfinished">Standardabweichungen werden mit {result_sd_factor:.1f} multipliziert</translation>
        </message>
        <message>
            <source>the pairs do not belong together: {px} px of each camera by itself; pictures not taken at the same moment, a board or a camera that moved do that: hold the board still and take them again; {done}</source>
            <translation type="unfinished">die Paare gehören nicht zusammen: {px} px jeder Kamera für sich; dazu kommt es, wenn die Bilder nicht im selben Moment gemacht wurden oder sich eine Tafel oder Kamera bewegt hat: Halten Sie die Tafel still und nehmen Sie sie noch einmal auf; {done}</translation>
        </message>
        <message>
            <source>the two cameras fit together less well than each by itself ({px} px): {done}</source>
            <translation type="unfinished">die beiden Kameras passen schlechter zusammen als jede für sich ({px} px): {done}</translation>
        </message>
        <message>
            <source>{path}: a file of names and values is needed, got {shown}</source>
            <translation type="unfinished">{path}: Nötig ist eine Datei mit Namen und Werten, gefunden wurde {shown}</translation>
        </message>
        <message>
            <source>a number of at least 0</source>
            <translation type="unfinished">eine Zahl von mindestens 0</translation>
        </message>
        <message>
            <source>rows: {rows}, cols: {columns} and data</source>
            <translation type="unfinished">rows: {rows}, cols: {columns} und data</translation>
        </message>
        <message>
            <source>{rows} x {columns}</source>
            <translation type="unfinished">{rows} x {columns}</translation>
        </message>
        <message>
            <source>{rows} rows of {columns}</source>
            <translation type="unfinished">Zeilen: {rows} zu je {columns}</translation>
        </message>
        <message>
            <source>{count} values</source>
            <translation type="unfinished">Werte: {count}</translation>
        </message>
        <message>
            <source>{rows} numbers</source>
            <translation type="unfinished">Zahlen: {rows}</translation>
        </message>
        <message>
            <source>a finite number</source>
            <translation type="unfinished">eine endliche Zahl</translation>
        </message>
        <message>
            <source>{path}: {key}: {wanted} is needed, got {shown}</source>
            <translation type="unfinished">{path}: {key}: Nötig ist {wanted}, gefunden wurde {shown}</translation>
        </message>
        <message>
            <source>{path}: {key} is missing; the file has {there}</source>
            <translation type="unfinished">{path}: {key} fehlt; die Datei hat {there}</translation>
        </message>
        <message>
            <source>a whole number of pixels from 16 to {largest_size}</source>
            <translation type="unfinished">eine ganze Zahl von Pixeln von 16 bis {largest_size}</translation>
        </message>
        <message>
            <source>{where}: fx 0 cx, 0 fy cy, 0 0 1 with positive focal lengths is needed, got {matrix}</source>
            <translation type="unfinished">{where}: Nötig ist fx 0 cx, 0 fy cy, 0 0 1 mit positiven Brennweiten, gefunden wurde {matrix}</translation>
        </message>
        <message>
            <source>{where}: a skew of {skew} px is not supported; only 0 is</source>
            <translation type="unfinished">{where}: Eine Scherung von {skew} px wird nicht unterstützt; nur 0</translation>
        </message>
        <message>
            <source>{where}: the first three columns are no rotation matrix: they differ from one by {error:.3g} (at most {rounded:g}) or mirror; got {matrix}</source>
            <translation type="unfinished">{where}: Die ersten drei Spalten sind keine Drehmatrix: Sie weichen um {error:.3g} davon ab (höchstens {rounded:g}) oder spiegeln; gefunden wurde {matrix}</translation>
        </message>
        <message>
            <source>{where}: its translation is {matrix} in units of {unit:g} m; cameras up to {farthest:g} m apart are read</source>
            <translation type="unfinished">{where}: Die Verschiebung ist {matrix} in Einheiten von {unit:g} m; gelesen werden Kameras mit bis zu {farthest:g} m Abstand</translation>
        </message>
        <message>
            <source>{left_source} and {right_source}: both cameras stand at the same place; the pair needs two different poses. Was the same file given twice, or only one camera's pose?</source>
            <translation type="unfinished">{left_source} und {right_source}: Beide Kameras stehen am selben Ort; das Paar braucht zwei verschiedene Lagen. Wurde dieselbe Datei zweimal angegeben oder nur die Lage einer Kamera?</translation>
        </message>
        <message>
            <source>{left_source} and {right_source}: {error}</source>
            <translation type="unfinished">{left_source} und {right_source}: {error}</translation>
        </message>
        <message>
            <source>{where}: {valid} coefficients{named} are possible, got {coefficients}</source>
            <translation type="unfinished">{where}: Möglich sind {valid} Koeffizienten{named}, gefunden wurden {coefficients}</translation>
        </message>
        <message>
            <source>{where}: a tilted sensor (τx, τy = {tilt_x:g}, {tilt_y:g}) is not supported: calibrate without CALIB_TILTED_MODEL, or the pictures with `acus calibrate stereo`</source>
            <translation type="unfinished">{where}: Ein gekippter Sensor (τx, τy = {tilt_x:g}, {tilt_y:g}) wird nicht unterstützt: Kalibrieren Sie ohne CALIB_TILTED_MODEL, oder die Bilder mit `acus calibrate stereo`</translation>
        </message>
        <message>
            <source>calibration {calibration_id} cannot be written to {path}: {error_strerror}; choose another place</source>
            <translation type="unfinished">die Kalibrierung {calibration_id} lässt sich nicht in {path} schreiben: {error_strerror}; wählen Sie einen anderen Ort</translation>
        </message>
        <message>
            <source>the lens of {camera_name} cannot be written to {path}: {error_strerror}; choose another place</source>
            <translation type="unfinished">das Objektiv von {camera_name} lässt sich nicht in {path} schreiben: {error_strerror}; wählen Sie einen anderen Ort</translation>
        </message>
        <message>
            <source>{path} is the lens of one camera; a calibration holds two and how they stand to each other. A pen takes it (`acus pen calibrate --lens`); for two cameras calibrate pairs of pictures (`acus calibrate stereo`)</source>
            <translation type="unfinished">{path} ist das Objektiv einer einzelnen Kamera; eine Kalibrierung enthält zwei und wie sie zueinander stehen. Ein Stift nimmt es (`acus pen calibrate --lens`); für zwei Kameras kalibrieren Sie Bildpaare (`acus calibrate stereo`)</translation>
        </message>
        <message>
            <source>{path}: pose or camera cannot be: {error}</source>
            <translation type="unfinished">{path}: Lage oder Kamera ist unmöglich: {error}</translation>
        </message>
        <message>
            <source>{folder}: two files cameraN_intrinsics.dat are needed, found {names}</source>
            <translation type="unfinished">{folder}: Nötig sind zwei Dateien cameraN_intrinsics.dat, gefunden: {names}</translation>
        </message>
        <message>
            <source>unit {unit} m: from 1e-6 (a micrometre) to 10 is valid</source>
            <translation type="unfinished">Einheit {unit} m: Gültig ist 1e-6 (ein Mikrometer) bis 10</translation>
        </message>
        <message>
            <source>cannot read {path}: {error_strerror}; check its name and that it may be read</source>
            <translation type="unfinished">{path} lässt sich nicht lesen: {error_strerror}; prüfen Sie den Namen und ob die Datei gelesen werden darf</translation>
        </message>
        <message>
            <source>{path} is no text file; one of lines of numbers is needed, as TemugeB's program writes it</source>
            <translation type="unfinished">{path} ist keine Textdatei; nötig ist eine mit Zeilen von Zahlen, wie das Programm von TemugeB sie schreibt</translation>
        </message>
        <message>
            <source>{path}: no line {title!r}; the file begins {lines}</source>
            <translation type="unfinished">{path}: Keine Zeile {title!r}; die Datei beginnt mit {lines}</translation>
        </message>
        <message>
            <source>{path}: {title} {needed_lines} lines of {columns} numbers are needed, got {numbers_by_line} numbers in {found_lines} lines</source>
            <translation type="unfinished">{path}: {title} Zeilen: {needed_lines} zu je {columns} Zahlen nötig, gefunden: {numbers_by_line} Zahlen in {found_lines} Zeilen</translation>
        </message>
        <message>
            <source>{path}: {title} numbers are needed, got {line!r}</source>
            <translation type="unfinished">{path}: {title} Zahlen sind nötig, gefunden wurde {line!r}</translation>
        </message>
        <message>
            <source>{path}: {title} finite numbers are needed, got {line!r}</source>
            <translation type="unfinished">{path}: {title} endliche Zahlen sind nötig, gefunden wurde {line!r}</translation>
        </message>
        <message>
            <source>{path}: its pose is missing: there is no {name} beside it</source>
            <translation type="unfinished">{path}: Die Lage fehlt: Daneben liegt kein {name}</translation>
        </message>
        <message>
            <source>{named}: OpenCV's files hold neither unit nor picture size; say them, e.g. --unit 1cm (the unit in which the board's square was typed) --size 640x480</source>
            <translation type="unfinished">{named}: Die Dateien von OpenCV enthalten weder Einheit noch Bildgröße; geben Sie beides an, z. B. --unit 1cm (die Einheit, in der die Quadratseite der Tafel eingetippt wurde) --size 640x480</translation>
        </message>
        <message>
            <source>{named}: a lens of OpenCV's one-camera sample; it does not say how two cameras stand to each other. Give what stereo_calib writes (intrinsics.yml and extrinsics.yml), or calibrate the pictures with `acus calibrate stereo`</source>
            <translation type="unfinished">{named}: ein Objektiv aus dem OpenCV-Beispiel für eine Kamera; es sagt nicht, wie zwei Kameras zueinander stehen. Geben Sie an, was stereo_calib schreibt (intrinsics.yml und extrinsics.yml), oder kalibrieren Sie die Bilder mit `acus calibrate stereo`</translation>
        </message>
        <message>
            <source>{named}: a pair of OpenCV needs M1, D1, M2, D2 (intrinsics.yml) and R, T (extrinsics.yml), found {there}; give both files</source>
            <translation type="unfinished">{named}: Ein Paar von OpenCV braucht M1, D1, M2, D2 (intrinsics.yml) und R, T (extrinsics.yml), gefunden: {there}; geben Sie beide Dateien an</translation>
        </message>
        <message>
            <source>{path}: {key}: {rows} x {columns} numbers are needed, got {found_shape}</source>
            <translation type="unfinished">{path}: {key}: Nötig sind {rows} x {columns} Zahlen, gefunden wurde {found_shape}</translation>
        </message>
        <message>
            <source>--unit {unit}: a length with its unit is needed, e.g. 1cm or 25.4mm</source>
            <translation type="unfinished">--unit {unit}: Nötig ist eine Länge mit Einheit, z. B. 1cm oder 25.4mm</translation>
        </message>
        <message>
            <source>--size {size}: WIDTHxHEIGHT in pixels is needed, e.g. 1280x720</source>
            <translation type="unfinished">--size {size}: Nötig ist WIDTHxHEIGHT in Pixeln, z. B. 1280x720</translation>
        </message>
        <message>
            <source>{files} files were given; {expected}</source>
            <translation type="unfinished">angegebene Dateien: {files}; {expected}</translation>
        </message>
        <message>
            <source>{left} and {right} are of different formats; {expected}</source>
            <translation type="unfinished">{left} und {right} haben verschiedene Formate; {expected}</translation>
        </message>
        <message>
            <source>{path} is no YAML file; {expected}</source>
            <translation type="unfinished">{path} ist keine YAML-Datei; {expected}</translation>
        </message>
        <message>
            <source>{folder}: TemugeB's files hold neither unit nor picture size; say them, e.g. --unit 1cm (the unit in which the board's square was typed) --size 1280x720</source>
            <translation type="unfinished">{folder}: Die Dateien von TemugeB enthalten weder Einheit noch Bildgröße; geben Sie beides an, z. B. --unit 1cm (die Einheit, in der die Quadratseite der Tafel eingetippt wurde) --size 1280x720</translation>
        </message>
        <message>
            <source>camera_info cannot be written to {path}: {error_strerror}</source>
            <translation type="unfinished">camera_info lässt sich nicht in {path} schreiben: {error_strerror}</translation>
        </message>
        <message>
            <source>the cameras look along the line between them: such a pair has no rectification and cannot be written as camera_info; export it as yaml</source>
            <translation type="unfinished">die Kameras blicken entlang ihrer Verbindungslinie: Ein solches Paar hat keine Rektifizierung und lässt sich nicht als camera_info schreiben; exportieren Sie es als yaml</translation>
        </message>
        <message>
            <source>{path}: {error}; write it again</source>
            <translation type="unfinished">{path}: {error}; schreiben Sie die Datei neu</translation>
        </message>
        <message>
            <source>it is larger than {largest_file} MB; a calibration is not</source>
            <translation type="unfinished">sie ist größer als {largest_file} MB; eine Kalibrierung ist das nicht</translation>
        </message>
        <message>
            <source>control characters are not read</source>
            <translation type="unfinished">Steuerzeichen werden nicht gelesen</translation>
        </message>
        <message>
            <source>it begins as a file of OpenCV's FileStorage but is damaged ({fault}); write it again</source>
            <translation type="unfinished">sie beginnt wie eine Datei von OpenCVs FileStorage, ist aber beschädigt ({fault}); schreiben Sie sie neu</translation>
        </message>
        <message>
            <source>OpenCV cannot read it</source>
            <translation type="unfinished">OpenCV kann sie nicht lesen</translation>
        </message>
        <message>
            <source>{double_name} is given twice</source>
            <translation type="unfinished">{double_name} ist zweimal angegeben</translation>
        </message>
        <message>
            <source>{key}: a matrix with rows, cols, dt and data is needed</source>
            <translation type="unfinished">{key}: Nötig ist eine Matrix mit rows, cols, dt und data</translation>
        </message>
        <message>
            <source>{key}: dt names the numbers' type, e.g. d; got {shown}</source>
            <translation type="unfinished">{key}: dt nennt den Zahlentyp, z. B. d; gefunden wurde {shown}</translation>
        </message>
        <message>
            <source>{key}: {rows} x {columns} numbers; at most {most} are read</source>
            <translation type="unfinished">{key}: {rows} x {columns} Zahlen; gelesen werden höchstens {most}</translation>
        </message>
        <message>
            <source>{key}: {rows} x {columns} numbers are needed, got {count} values</source>
            <translation type="unfinished">{key}: Nötig sind {rows} x {columns} Zahlen, gefundene Werte: {count}</translation>
        </message>
        <message>
            <source>{where}: a whole number from 1 to {most} is needed</source>
            <translation type="unfinished">{where}: Nötig ist eine ganze Zahl von 1 bis {most}</translation>
        </message>
        <message>
            <source>{key}: a matrix of finite numbers is needed, got {shown}</source>
            <translation type="unfinished">{key}: Nötig ist eine Matrix endlicher Zahlen, gefunden wurde {shown}</translation>
        </message>
        <message>
            <source>{key}: a whole number is too large, got {length:.0f} or more</source>
            <translation type="unfinished">{key}: Eine ganze Zahl ist zu groß, gefunden wurde {length:.0f} oder mehr</translation>
        </message>
        <message>
            <source>{path}: id: {needed_id} is needed as the file's name says, got {stated_id}; was the file renamed?</source>
            <translation type="unfinished">{path}: id: Nötig ist {needed_id}, wie der Dateiname sagt, gefunden wurde {stated_id}; wurde die Datei umbenannt?</translation>
        </message>
        <message>
            <source>{trouble} with {beginning!r}; there are {names}</source>
            <translation type="unfinished">{trouble} mit {beginning!r}; vorhanden: {names}</translation>
        </message>
        <message>
            <source>a calibration cannot be called {name!r}: give it another id</source>
            <translation type="unfinished">eine Kalibrierung kann nicht {name!r} heißen: Geben Sie ihr eine andere Kennung</translation>
        </message>
        <message>
            <source>another calibration is already kept as {calibration_id}; nothing is overwritten: give this one another id</source>
            <translation type="unfinished">eine andere Kalibrierung ist schon als {calibration_id} gespeichert; nichts wird überschrieben: Geben Sie dieser eine andere Kennung</translation>
        </message>
        <message>
            <source>calibration {entry_id} was found bad ({entry_rejected_reason}); calibrate again or use another one</source>
            <translation type="unfinished">die Kalibrierung {entry_id} erwies sich als schlecht ({entry_rejected_reason}); kalibrieren Sie neu oder verwenden Sie eine andere</translation>
        </message>
        <message>
            <source>no calibration is in use: there is nothing to undo</source>
            <translation type="unfinished">es ist keine Kalibrierung in Gebrauch: Es gibt nichts rückgängig zu machen</translation>
        </message>
        <message>
            <source>there is no undone calibration that could be used again</source>
            <translation type="unfinished">es gibt keine rückgängig gemachte Kalibrierung, die wieder verwendet werden könnte</translation>
        </message>
        <message>
            <source>say why the calibration is bad: attempts are flagged with it</source>
            <translation type="unfinished">sagen Sie, warum die Kalibrierung schlecht ist: Versuche werden damit gekennzeichnet</translation>
        </message>
        <message>
            <source>the history of calibrations cannot be written to {path}: {error_strerror}</source>
            <translation type="unfinished">der Verlauf der Kalibrierungen lässt sich nicht in {path} schreiben: {error_strerror}</translation>
        </message>
        <message>
            <source>position {position} lies beyond the {used_positions} used</source>
            <translation type="unfinished">position {position} liegt hinter den {used_positions} benutzten</translation>
        </message>
        <message>
            <source>used names {unknown}, which no calibration has</source>
            <translation type="unfinished">used nennt {unknown}, und keine Kalibrierung heißt so</translation>
        </message>
        <message>
            <source>{error}; mend the file or move it away</source>
            <translation type="unfinished">{error}; berichtigen Sie die Datei oder legen Sie sie beiseite</translation>
        </message>
        <message>
            <source>calibrate the cameras first: no calibration is in use</source>
            <translation type="unfinished">kalibrieren Sie zuerst die Kameras: Es ist keine Kalibrierung in Gebrauch</translation>
        </message>
        <message>
            <source>{name}: first estimate</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{name}: views held back</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{name}: which coefficients the views support</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>first estimate</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>camera {name}: {usable_views} usable views of the board; at least {least_views} are needed, 15 to 30 are good</source>
            <translation type="unfinished">Kamera {name}: brauchbare Aufnahmen der Tafel: {usable_views}; nötig sind mindestens {least_views}, gut sind 15 bis 30</translation>
        </message>
        <message>
            <source>camera {name}: views of different boards, {boards}</source>
            <translation type="unfinished">Kamera {name}: Aufnahmen verschiedener Tafeln, {boards}</translation>
        </message>
        <message>
            <source>camera {name}: pictures of different sizes: {view_name} has {width}x{height} ({differing_views} of {views} are not {usual_width}x{usual_height}); one camera at one resolution is needed: leave the others out</source>
            <translation type="unfinished">Kamera {name}: Bilder verschiedener Größe: {view_name} hat {width}x{height} ({differing_views} von {views} haben nicht {usual_width}x{usual_height}); nötig ist eine Kamera mit einer Auflösung: Lassen Sie die anderen weg</translation>
        </message>
        <message>
            <source>camera {name}: the views do not determine the focal length ({focal_px:.0f} ± {spread_px:.0f} px; at most {most_focal_spread:.0%} is taken); boards that are all parallel cannot: tilt the board to different sides by 20 to 45 degrees</source>
            <translation type="unfinished">Kamera {name}: Die Aufnahmen bestimmen die Brennweite nicht ({focal_px:.0f} ± {spread_px:.0f} px; höchstens {most_focal_spread:.0%} wird angenommen); Tafeln, die alle parallel sind, können das nicht: Neigen Sie die Tafel um 20 bis 45 Grad nach verschiedenen Seiten</translation>
        </message>
        <message>
            <source>skipped: {names}: not pictures whose names say one of the two cameras</source>
            <translation type="unfinished">übersprungen: {names}: keine Bilder, deren Namen eine der beiden Kameras nennen</translation>
        </message>
        <message>
            <source>no partner: {names}: used for the {side} camera alone</source>
            <translation type="unfinished">kein Gegenstück: {names}: nur für die Kamera {side} allein verwendet</translation>
        </message>
        <message>
            <source>{listed}: the name does not say the camera; name pictures e.g. left01.png and right01.png, or camera0_1.png and camera1_1.png</source>
            <translation type="unfinished">{listed}: Der Name sagt nicht, welche Kamera es ist; benennen Sie Bilder z. B. left01.png und right01.png oder camera0_1.png und camera1_1.png</translation>
        </message>
        <message>
            <source>the names of the pictures speak of {cameras} camera(s); two are needed, e.g. left01.png and right01.png</source>
            <translation type="unfinished">Kameras, von denen die Bildnamen sprechen: {cameras}; nötig sind zwei, z. B. left01.png und right01.png</translation>
        </message>
        <message>
            <source>{listed}: no picture of the other camera has that number; name those taken together alike (docs/calibration.md says how names are paired)</source>
            <translation type="unfinished">{listed}: Kein Bild der anderen Kamera hat diese Nummer; benennen Sie gemeinsam aufgenommene Bilder gleich (docs/calibration.md sagt, wie Namen gepaart werden)</translation>
        </message>
        <message>
            <source>{known_name} and {path_name} are both number {picture_number} of one camera; keep one of them</source>
            <translation type="unfinished">{known_name} und {path_name} haben bei derselben Kamera beide die Nummer {picture_number}; behalten Sie eines davon</translation>
        </message>
        <message>
            <source>{no_folder}; give the folder of the pictures</source>
            <translation type="unfinished">{no_folder}; geben Sie den Ordner der Bilder an</translation>
        </message>
        <message>
            <source>no picture{named} in {folder}; choose the folder of the pictures ({suffixes} are read)</source>
            <translation type="unfinished">kein Bild{named} in {folder}; wählen Sie den Ordner der Bilder (gelesen werden {suffixes})</translation>
        </message>
        <message>
            <source>{count} pictures in {folder}, {most_pictures} are the most: put 20 to 200 of them, of different views, into a folder of their own</source>
            <translation type="unfinished">Bilder in {folder}: {count}, höchstens {most_pictures}: Legen Sie 20 bis 200 davon, verschiedene Aufnahmen, in einen eigenen Ordner</translation>
        </message>
        <message>
            <source>cannot be read: {error_strerror}</source>
            <translation type="unfinished">lässt sich nicht lesen: {error_strerror}</translation>
        </message>
        <message>
            <source>cannot be used: {short}</source>
            <translation type="unfinished">lässt sich nicht verwenden: {short}</translation>
        </message>
        <message>
            <source>looking for the board</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>read at {name}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>the board measures {fit_scale:.4f} ± {fit_scale_sd:.4f} times what its specification says: measure a square, or was the calibration made with another board?</source>
            <translation type="unfinished">die Tafel misst {fit_scale:.4f} ± {fit_scale_sd:.4f} mal so viel, wie ihre Angabe sagt: Messen Sie ein Quadrat nach, oder wurde mit einer anderen Tafel kalibriert?</translation>
        </message>
        <message>
            <source>the corners lie {fit_rms_px:.2f} px from where they should ({limit:.2f} px is the limit), worst in {worst_picture} ({worst_px:.2f} px): did the board move between the pictures, did a camera, or are left and right exchanged?</source>
            <translation type="unfinished">die Ecken liegen {fit_rms_px:.2f} px neben ihrem Sollort (Grenze {limit:.2f} px), am schlimmsten in {worst_picture} ({worst_px:.2f} px): Hat sich zwischen den Bildern die Tafel oder eine Kamera bewegt, oder sind links und rechts vertauscht?</translation>
        </message>
        <message>
            <source>the place says that the print faces down; a board that lies print up is turned by 180 degrees about x: --at x,y,z,180,0,rz</source>
            <translation type="unfinished">laut Lageangabe zeigt der Druck nach unten; eine Tafel mit dem Druck nach oben ist um 180 Grad um x gedreht: --at x,y,z,180,0,rz</translation>
        </message>
        <message>
            <source>camera {camera_name} would look at the board from behind: is its picture mirrored, or is the calibration one of other cameras?</source>
            <translation type="unfinished">die Kamera {camera_name} würde von hinten auf die Tafel blicken: Ist ihr Bild gespiegelt, oder gehört die Kalibrierung zu anderen Kameras?</translation>
        </message>
        <message>
            <source>camera {camera_name} stands {centre_mm:.0f} mm below the robot's plane (z = 0): is the board's place right?</source>
            <translation type="unfinished">die Kamera {camera_name} steht {centre_mm:.0f} mm unter der Ebene des Roboters (z = 0): Stimmt die Lage der Tafel?</translation>
        </message>
        <message>
            <source>camera {model_name} does not see the needle's place: is the board's place right, and does the camera look at the needle?</source>
            <translation type="unfinished">die Kamera {model_name} sieht den Ort der Nadel nicht: Stimmt die Lage der Tafel, und blickt die Kamera auf die Nadel?</translation>
        </message>
        <message>
            <source>the places disagree by {away_mm:.1f} mm at the left camera: was a board laid wrongly?</source>
            <translation type="unfinished">die Lagen weichen bei der linken Kamera um {away_mm:.1f} mm voneinander ab: Lag eine Tafel falsch?</translation>
        </message>
        <message>
            <source>the board was not seen within {live_timeout:.0f} s: {reason}</source>
            <translation type="unfinished">die Tafel war innerhalb von {live_timeout:.0f} s nicht zu sehen: {reason}</translation>
        </message>
        <message>
            <source>{folders} folders and {places} places were given; each folder needs the place of its board: --images DIR --at x,y,z[,rx,ry,rz]</source>
            <translation type="unfinished">angegebene Ordner: {folders}, Lagen: {places}; jeder Ordner braucht die Lage seiner Tafel: --images DIR --at x,y,z[,rx,ry,rz]</translation>
        </message>
        <message>
            <source>{folder}: {none_seen}</source>
            <translation type="unfinished">{folder}: {none_seen}</translation>
        </message>
        <message>
            <source>no camera explains the {views} views; tilt the board to different sides by 20 to 45 degrees, and check the board's counts</source>
            <translation type="unfinished">keine Kamera erklärt die {views} Aufnahmen; neigen Sie die Tafel um 20 bis 45 Grad nach verschiedenen Seiten und prüfen Sie die Anzahlen der Tafel</translation>
        </message>
        <message>
            <source>view {view_name!r}: no pose of the board fits before the camera</source>
            <translation type="unfinished">Aufnahme {view_name!r}: Keine Lage der Tafel vor der Kamera passt</translation>
        </message>
        <message>
            <source>view {view_name!r}: no pose of the board can be found</source>
            <translation type="unfinished">Aufnahme {view_name!r}: Es lässt sich keine Lage der Tafel finden</translation>
        </message>
        <message>
            <source>{name}: {r_name} does not fit ({r_rms_px:.2f} px against {adjusted_rms_px:.2f} px): left out</source>
            <translation type="unfinished">{name}: {r_name} passt nicht ({r_rms_px:.2f} px gegenüber {adjusted_rms_px:.2f} px): ausgelassen</translation>
        </message>
        <message>
            <source>{name}: fy/fx = {ratio:.4f}: the pixels or the squares are not square; measure the print in both directions</source>
            <translation type="unfinished">{name}: fy/fx = {ratio:.4f}: Die Pixel oder die Quadrate sind nicht quadratisch; messen Sie den Druck in beiden Richtungen nach</translation>
        </message>
        <message>
            <source>{name}: this lens is wider than the five-coefficient model, or bends otherwise: seen up to {angle:.0f}° off its axis, {five_px:.3f} px remain with five coefficients, {adjusted_rms_px:.3f} px with the {lens_words}: calibrated with that</source>
            <translation type="unfinished">{name}: Dieses Objektiv ist weiter als das Modell mit fünf Koeffizienten oder verzerrt anders: bis {angle:.0f}° neben seiner Achse genutzt, {five_px:.3f} px bleiben mit fünf Koeffizienten, {adjusted_rms_px:.3f} px mit {lens_words}: damit kalibriert</translation>
        </message>
        <message>
            <source>{name}: corners fit better unrefined and are taken so (blur, noise): {named}</source>
            <translation type="unfinished">{name}: Ecken passen unverfeinert besser und werden so genommen (Unschärfe, Rauschen): {named}</translation>
        </message>
        <message>
            <source>{name}: corners reach {reach:.0%} of the way to the picture's corners; distortion beyond is not measured: show the board at the edges too</source>
            <translation type="unfinished">{name}: Die Ecken der Tafel reichen {reach:.0%} des Wegs bis in die Bildecken; die Verzeichnung darüber hinaus ist nicht gemessen: Zeigen Sie die Tafel auch an den Rändern</translation>
        </message>
        <message>
            <source>{mended} of {pairs} pairs had their corners numbered from opposite ends; mended: {mended_names}</source>
            <translation type="unfinished">bei {mended} von {pairs} Paaren waren die Ecken von entgegengesetzten Enden aus nummeriert; behoben: {mended_names}</translation>
        </message>
        <message>
            <source>{r_name} does not fit the other pairs ({r_rms_px:.2f} px against {adjusted_rms_px:.2f} px): left out</source>
            <translation type="unfinished">{r_name} passt nicht zu den anderen Paaren ({r_rms_px:.2f} px gegenüber {adjusted_rms_px:.2f} px): ausgelassen</translation>
        </message>
        <message>
            <source>camera {right_name} stands {distance_mm:.0f} mm to the left of camera {left_name}: the two may be swapped</source>
            <translation type="unfinished">die Kamera {right_name} steht {distance_mm:.0f} mm links von der Kamera {left_name}: Die beiden sind vielleicht vertauscht</translation>
        </message>
        <message>
            <source>pictures of different sizes, {left_name} {w0}x{h0}, {right_name} {w1}x{h1}: the trainer takes both cameras at one size; set both to it and take the pictures again</source>
            <translation type="unfinished">Bilder verschiedener Größe, {left_name} {w0}x{h0}, {right_name} {w1}x{h1}: Der Trainer braucht beide Kameras in derselben Größe; stellen Sie beide darauf ein und machen Sie die Bilder noch einmal</translation>
        </message>
        <message>
            <source>{name}: the board moved while its pictures were read row by row (rolling shutter): it looks bent differently in each, by {moved:.2g} px, and focal length and distances come out wrong; lay the board down or hold it against something still, and take the pictures again, or use a camera with a global shutter</source>
            <translation type="unfinished">{name}: Die Tafel bewegte sich, während ihre Bilder zeilenweise ausgelesen wurden (Rolling Shutter): Sie sieht in jedem anders verbogen aus, um {moved:.2g} px, und Brennweite und Abstände werden falsch; legen Sie die Tafel hin oder halten Sie sie an etwas Festes und machen Sie die Bilder noch einmal, oder verwenden Sie eine Kamera mit Global Shutter</translation>
        </message>
        <message>
            <source>{left_views} left and {right_views} right views; they are taken in pairs: give None where a camera did not see the board</source>
            <translation type="unfinished">Aufnahmen links: {left_views}, rechts: {right_views}; sie werden paarweise genommen: Geben Sie None an, wo eine Kamera die Tafel nicht sah</translation>
        </message>
        <message>
            <source>pairs held back</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>calibrated</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{name} = {estimate:.3g} ± {sd:.2g}: the views do not tell; taken as 0</source>
            <translation type="unfinished">{name} = {estimate:.3g} ± {sd:.2g}: Die Aufnahmen sagen nichts darüber; als 0 genommen</translation>
        </message>
        <message>
            <source>{both} of {pairs} pairs show the board to both cameras; at least {least_pairs} are needed, 15 to 30 are good; {common_reasons}</source>
            <translation type="unfinished">{both} von {pairs} Paaren zeigen beiden Kameras die Tafel; nötig sind mindestens {least_pairs}, gut sind 15 bis 30; {common_reasons}</translation>
        </message>
        <message>
            <source>the board is usable in none of {pictures} pictures (or pairs); {common_reasons}</source>
            <translation type="unfinished">die Tafel ist in keinem der Bilder (oder Paare) brauchbar, geprüft: {pictures}; {common_reasons}</translation>
        </message>
        <message>
            <source>{pairs} pairs show the board to both cameras; at least {least_pairs} are needed, 15 to 30 are good</source>
            <translation type="unfinished">Paare, die beiden Kameras die Tafel zeigen: {pairs}; nötig sind mindestens {least_pairs}, gut sind 15 bis 30</translation>
        </message>
        <message>
            <source>which corner is which</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>left and right show the same pictures: both come from one camera; choose another source for one of them</source>
            <translation type="unfinished">links und rechts zeigen dieselben Bilder: Beide kommen von einer Kamera; wählen Sie für eine davon eine andere Quelle</translation>
        </message>
        <message>
            <source>the two cameras stand at one place ({apart:.2f} mm apart, the board {far:.0f} mm away); both pictures seem to come from one camera: choose another source for one of them, or move them apart</source>
            <translation type="unfinished">die beiden Kameras stehen an einem Ort ({apart:.2f} mm auseinander, die Tafel {far:.0f} mm entfernt); beide Bilder scheinen von einer Kamera zu kommen: Wählen Sie für eine davon eine andere Quelle, oder rücken Sie die Kameras auseinander</translation>
        </message>
        <message>
            <source>the pictures of one of the two cameras are mirrored: the pairs fit once one side is mirrored back; turn mirror mode off in that camera's settings and take them again</source>
            <translation type="unfinished">die Bilder einer der beiden Kameras sind gespiegelt: Die Paare passen, sobald eine Seite zurückgespiegelt wird; schalten Sie die Spiegelung in den Einstellungen dieser Kamera aus und machen Sie die Bilder noch einmal</translation>
        </message>
        <message>
            <source>the pairs do not agree on where the cameras stand: {agreeing_pairs} of {pairs} fit together within {agreement_near:.0f} px; pictures that were not taken together, cameras moved in between, or names paired wrongly do that</source>
            <translation type="unfinished">die Paare sind sich nicht einig, wo die Kameras stehen: {agreeing_pairs} von {pairs} passen auf {agreement_near:.0f} px zusammen; das kommt von Bildern, die nicht gleichzeitig gemacht wurden, von Kameras, die dazwischen bewegt wurden, oder von falsch gepaarten Namen</translation>
        </message>
        <message>
            <source>none of {pairs} pairs shares {least_shared} corners; nothing can be validated</source>
            <translation type="unfinished">Paare: {pairs}, und keines hat {least_shared} gemeinsame Ecken; nichts lässt sich überprüfen</translation>
        </message>
        <message>
            <source>rays of the two cameras are parallel; nothing can be triangulated</source>
            <translation type="unfinished">die Sehstrahlen der beiden Kameras sind parallel; nichts lässt sich triangulieren</translation>
        </message>
        <message>
            <source>camera {camera_name}: {missing} corners lie where its distortion folds back; the calibration does not reach there</source>
            <translation type="unfinished">Kamera {camera_name}: {missing} Ecken liegen dort, wo die Verzeichnung zurückklappt; die Kalibrierung reicht nicht bis dorthin</translation>
        </message>
        <message>
            <source>a length that is known contradicts it: {against_text}</source>
            <translation type="unfinished">eine bekannte Länge widerspricht: {against_text}</translation>
        </message>
        <message>
            <source>where the marker comes</source>
            <translation type="unfinished">im Bereich des Markers</translation>
        </message>
        <message>
            <source>in a quarter of its picture</source>
            <translation type="unfinished">in einem Viertel des Bildes</translation>
        </message>
        <message>
            <source>{name}: {where} its rays are known to ± {sd:.2g} px only, {mm:.2g} mm at {usual_distance_mm:.0f} mm ({good:.2g} mm is good): the board was not seen there; show it there too, up to the edges</source>
            <translation type="unfinished">{name}: {where} sind die Sehstrahlen nur auf ± {sd:.2g} px bekannt, {mm:.2g} mm bei {usual_distance_mm:.0f} mm ({good:.2g} mm sind gut): Die Tafel war dort nicht zu sehen; zeigen Sie sie auch dort, bis an die Ränder</translation>
        </message>
        <message>
            <source>glue the board on something flat, take sharper pictures, check its counts and sizes</source>
            <translation type="unfinished">kleben Sie die Tafel auf etwas Ebenes, machen Sie schärfere Bilder, prüfen Sie Anzahlen und Größen</translation>
        </message>
        <message>
            <source>residual of {rms:.2f} px, at most {worst_px:.2g} px: {flat}</source>
            <translation type="unfinished">Restfehler {rms:.2f} px, höchstens {worst_px:.2g} px: {flat}</translation>
        </message>
        <message>
            <source>pairs held back are wrong by {checked_rms_mm:.2f} mm RMS at {away:.0f} mm</source>
            <translation type="unfinished">Kontrollpaare weichen bei {away:.0f} mm um {checked_rms_mm:.2f} mm RMS ab</translation>
        </message>
        <message>
            <source>{held}, at most {worst_share:.2g} mm: {flat}</source>
            <translation type="unfinished">{held}, höchstens {worst_share:.2g} mm: {flat}</translation>
        </message>
        <message>
            <source>the pairs do not belong together: hold the board still while both cameras look, fix the cameras, and take them again</source>
            <translation type="unfinished">die Paare gehören nicht zusammen: Halten Sie die Tafel still, während beide Kameras hinsehen, befestigen Sie die Kameras, und nehmen Sie die Paare noch einmal auf</translation>
        </message>
        <message>
            <source>rolling shutter: the board moved while the pictures of {named} were read row by row, which makes focal length and distances wrong and hardly shows in the residual: hold the board against something still, and take them again</source>
            <translation type="unfinished">Rolling Shutter: Die Tafel bewegte sich, während die Bilder von {named} zeilenweise ausgelesen wurden; das macht Brennweite und Abstände falsch und zeigt sich im Restfehler kaum: Halten Sie die Tafel an etwas Festes und nehmen Sie die Bilder noch einmal auf</translation>
        </message>
        <message>
            <source>it fits, but no pair was held back to check it: take at least eight pairs</source>
            <translation type="unfinished">es passt, aber zum Überprüfen wurde kein Paar zurückgehalten: Nehmen Sie mindestens acht Paare auf</translation>
        </message>
        <message>
            <source>more and sharper views will do better</source>
            <translation type="unfinished">mehr und schärfere Aufnahmen helfen</translation>
        </message>
        <message>
            <source>residual of {rms:.2f} px, {good_px:.2g} px is good: {better}</source>
            <translation type="unfinished">Restfehler {rms:.2f} px, gut sind {good_px:.2g} px: {better}</translation>
        </message>
        <message>
            <source>{held}, {good_share:.2g} mm is good: {better}</source>
            <translation type="unfinished">{held}, gut sind {good_share:.2g} mm: {better}</translation>
        </message>
        <message>
            <source>lengths on pairs held back are {checked_scale:.4f} times the true ones: {better}</source>
            <translation type="unfinished">Längen auf Kontrollpaaren sind {checked_scale:.4f}-mal die wahren: {better}</translation>
        </message>
        <message>
            <source>pairs that took no part come out right: {held}</source>
            <translation type="unfinished">Paare, die nicht beteiligt waren, kommen richtig heraus: {held}</translation>
        </message>
        <message>
            <source>view {name!r}: {ids_size} corner numbers and pixels of shape {pixels_shape}; one finite pixel is needed for every corner</source>
            <translation type="unfinished">Aufnahme {name!r}: Eckennummern: {ids_size}, Pixel der Form {pixels_shape}; für jede Ecke ist ein endlicher Pixel nötig</translation>
        </message>
        <message>
            <source>view {name!r}: corner {corner_number} is not on the board {board_spec}, which has {corners}</source>
            <translation type="unfinished">Aufnahme {name!r}: Die Ecke {corner_number} liegt nicht auf der Tafel {board_spec}, diese hat {corners}</translation>
        </message>
        <message>
            <source>view {name!r}: unrefined pixels of shape {rough_shape}; one finite pixel is needed for every corner</source>
            <translation type="unfinished">Aufnahme {name!r}: unverfeinerte Pixel der Form {rough_shape}; für jede Ecke ist ein endlicher Pixel nötig</translation>
        </message>
        <message>
            <source>no board was given: one picture of it at a known place is needed</source>
            <translation type="unfinished">keine Tafel angegeben: Nötig ist ein Bild von ihr an einem bekannten Ort</translation>
        </message>
        <message>
            <source>the board looks the same after half a turn, so the world could be turned by 180°: use a ChArUco board, or one with an odd and an even count of corners, or say where the cameras stand roughly (--rig)</source>
            <translation type="unfinished">die Tafel sieht nach einer halben Drehung gleich aus, die Welt könnte also um 180° gedreht sein: Verwenden Sie eine ChArUco-Tafel oder eine mit einer ungeraden und einer geraden Eckenzahl, oder sagen Sie ungefähr, wo die Kameras stehen (--rig)</translation>
        </message>
        <message>
            <source>a picture has shape {image_shape} and type {image_dtype}; (height, width, 3) and uint8 are needed: set the camera to colour</source>
            <translation type="unfinished">ein Bild hat die Form {image_shape} und den Typ {image_dtype}; nötig sind (height, width, 3) und uint8: Stellen Sie die Kamera auf Farbe</translation>
        </message>
        <message>
            <source>{name}: the driver did not accept {asked} (it is at {got:g})</source>
            <translation type="unfinished">{name}: Der Treiber nahm {asked} nicht an (Wert jetzt: {got:g})</translation>
        </message>
        <message>
            <source>the camera gives pictures of {given_width}x{given_height} where {width}x{height} was asked for; set `size` in the camera settings to one that the camera has and calibrate at it</source>
            <translation type="unfinished">die Kamera liefert Bilder von {given_width}x{given_height}, verlangt waren {width}x{height}; setzen Sie `size` in den Kameraeinstellungen auf eine Größe, die die Kamera hat, und kalibrieren Sie bei dieser</translation>
        </message>
        <message>
            <source>camera {name} ({source}) gives pictures of {width}x{height}, not {known_width}x{known_height} ({reason}); set `size` in the camera settings, or calibrate again at this size</source>
            <translation type="unfinished">die Kamera {name} ({source}) liefert Bilder von {width}x{height}, nicht {known_width}x{known_height} ({reason}); setzen Sie `size` in den Kameraeinstellungen, oder kalibrieren Sie neu bei dieser Größe</translation>
        </message>
        <message>
            <source>camera {name} ({source}): {error}</source>
            <translation type="unfinished">Kamera {name} ({source}): {error}</translation>
        </message>
        <message>
            <source>a simulated camera needs a needle to look at; choose a real source here</source>
            <translation type="unfinished">eine simulierte Kamera braucht eine Nadel, auf die sie blickt; wählen Sie hier eine echte Quelle</translation>
        </message>
        <message>
            <source>no picture from the {side} camera</source>
            <translation type="unfinished">kein Bild von der Kamera {side}</translation>
        </message>
        <message>
            <source>folder {folder} is not open; call open() first</source>
            <translation type="unfinished">der Ordner {folder} ist nicht geöffnet; rufen Sie zuerst open() auf</translation>
        </message>
        <message>
            <source>the {pictures} pictures of {folder} are over</source>
            <translation type="unfinished">die Bilder von {folder} sind zu Ende ({pictures})</translation>
        </message>
        <message>
            <source>the pictures of {folder} are of different sizes: {each}</source>
            <translation type="unfinished">die Bilder von {folder} haben verschiedene Größen: {each}</translation>
        </message>
        <message>
            <source>only the first {most} of {pictures} pictures were looked at</source>
            <translation type="unfinished">angesehen wurden nur die ersten {most} von {pictures} Bildern</translation>
        </message>
        <message>
            <source>{no_folder}; folder:PATH names a folder</source>
            <translation type="unfinished">{no_folder}; folder:PATH nennt einen Ordner</translation>
        </message>
        <message>
            <source>no picture in {folder}; files that end in {endings} count</source>
            <translation type="unfinished">kein Bild in {folder}; es zählen Dateien mit der Endung {endings}</translation>
        </message>
        <message>
            <source>there is no video {path}; video:PATH names a file</source>
            <translation type="unfinished">es gibt kein Video {path}; video:PATH nennt eine Datei</translation>
        </message>
        <message>
            <source>{path} is no video that can be read</source>
            <translation type="unfinished">{path} ist kein lesbares Video</translation>
        </message>
        <message>
            <source>video {path} is not open; call open() first</source>
            <translation type="unfinished">das Video {path} ist nicht geöffnet; rufen Sie zuerst open() auf</translation>
        </message>
        <message>
            <source>a picture of {path} is damaged</source>
            <translation type="unfinished">ein Bild von {path} ist beschädigt</translation>
        </message>
        <message>
            <source>the video {path} is over</source>
            <translation type="unfinished">das Video {path} ist zu Ende</translation>
        </message>
        <message>
            <source>with times that go back</source>
            <translation type="unfinished">mit rückwärts laufenden Zeiten</translation>
        </message>
        <message>
            <source>with impossible times</source>
            <translation type="unfinished">mit unmöglichen Zeiten</translation>
        </message>
        <message>
            <source>{median:.1f} ± {error:.1f} ms (spread of a single picture {sd:.1f} ms, {n} changes)</source>
            <translation type="unfinished">{median:.1f} ± {error:.1f} ms (Streuung eines einzelnen Bildes {sd:.1f} ms, Wechsel: {n})</translation>
        </message>
        <message>
            <source>the pictures do not follow the blinking (correlation {agreement:.2f}, at least {least_agreement} is needed); put the camera close to the patch, out of other light, and hold its exposure</source>
            <translation type="unfinished">die Bilder folgen dem Blinken nicht (Korrelation {agreement:.2f}, nötig ist mindestens {least_agreement}); stellen Sie die Kamera nah an das Feld, fern von anderem Licht, und halten Sie ihre Belichtung fest</translation>
        </message>
        <message>
            <source>{changes} changes and {pictures} pictures are too few; at least {fewest_changes} and {fewest_pictures} are needed: let the test run to its end</source>
            <translation type="unfinished">zu wenig: Wechsel {changes}, Bilder {pictures}; nötig sind mindestens {fewest_changes} und {fewest_pictures}: Lassen Sie den Test bis zum Ende laufen</translation>
        </message>
        <message>
            <source>the times of the changes must increase; repeat the test</source>
            <translation type="unfinished">die Zeiten der Wechsel müssen zunehmen; wiederholen Sie den Test</translation>
        </message>
        <message>
            <source>the patch changes the picture by {contrast:.1f} grey levels, at least {least_contrast:g} are needed; point the camera at the patch, and check its exposure</source>
            <translation type="unfinished">das Feld ändert das Bild um {contrast:.1f} Graustufen, nötig sind mindestens {least_contrast:g}; richten Sie die Kamera auf das Feld und prüfen Sie ihre Belichtung</translation>
        </message>
        <message>
            <source>{seen} changes were seen, at least {fewest} are needed; the patch must stay longer between two changes than two pictures of the camera</source>
            <translation type="unfinished">gesehene Wechsel: {seen}, nötig sind mindestens {fewest}; das Feld muss zwischen zwei Wechseln länger stehen, als zwei Bilder der Kamera auseinanderliegen</translation>
        </message>
        <message>
            <source>a picture of {width}x{height} is too small for the test of latency</source>
            <translation type="unfinished">ein Bild von {width}x{height} ist zu klein für den Latenztest</translation>
        </message>
        <message>
            <source>no picture came while the patch was blinking; is the camera running?</source>
            <translation type="unfinished">während das Feld blinkte, kam kein Bild; läuft die Kamera?</translation>
        </message>
        <message>
            <source>no camera at usb:{place}; {plugged_in}</source>
            <translation type="unfinished">keine Kamera an usb:{place}; {plugged_in}</translation>
        </message>
        <message>
            <source>none is plugged in: check the cable, and `acus camera list`</source>
            <translation type="unfinished">keine ist angeschlossen: Prüfen Sie das Kabel und `acus camera list`</translation>
        </message>
        <message>
            <source>plugged in are: </source>
            <translation type="unfinished">angeschlossen sind: </translation>
        </message>
        <message>
            <source>one camera is real and one simulated (left {left}, right {right}); give both a source, for example --cameras left=usb:1-1.1,right=usb:1-1.2</source>
            <translation type="unfinished">eine Kamera ist echt und eine simuliert (links {left}, rechts {right}); geben Sie beiden eine Quelle, zum Beispiel --cameras left=usb:1-1.1,right=usb:1-1.2</translation>
        </message>
        <message>
            <source>left and right are the same source, {left}; the depth needs two cameras: `acus camera list` shows what is plugged in</source>
            <translation type="unfinished">links und rechts sind dieselbe Quelle, {left}; die Tiefe braucht zwei Kameras: `acus camera list` zeigt, was angeschlossen ist</translation>
        </message>
        <message>
            <source>{wanted!r} names no cameras; give `simulated`, a settings file (.yaml), or left=SOURCE,right=SOURCE, for example left=usb:1-1.1,right=usb:1-1.2</source>
            <translation type="unfinished">{wanted!r} nennt keine Kameras; geben Sie `simulated`, eine Einstellungsdatei (.yaml) oder left=SOURCE,right=SOURCE an, zum Beispiel left=usb:1-1.1,right=usb:1-1.2</translation>
        </message>
        <message>
            <source>{source!r} is no source of pictures; valid are: {forms}</source>
            <translation type="unfinished">{source!r} ist keine Bildquelle; gültig sind: {forms}</translation>
        </message>
        <message>
            <source>the source {source!r} {lack}; valid are: {forms}</source>
            <translation type="unfinished">die Quelle {source!r} {lack}; gültig sind: {forms}</translation>
        </message>
        <message>
            <source>cannot write {folder}.png</source>
            <translation type="unfinished">{folder}.png lässt sich nicht schreiben</translation>
        </message>
        <message>
            <source>cannot write into {folder}: {error_strerror}</source>
            <translation type="unfinished">in {folder} lässt sich nicht schreiben: {error_strerror}</translation>
        </message>
        <message>
            <source>there is no folder {origin_place}</source>
            <translation type="unfinished">es gibt keinen Ordner {origin_place}</translation>
        </message>
        <message>
            <source>there is no video {origin_place}</source>
            <translation type="unfinished">es gibt kein Video {origin_place}</translation>
        </message>
        <message>
            <source>{saturated:.0%} of the picture is overexposed: lower the exposure</source>
            <translation type="unfinished">{saturated:.0%} des Bildes sind überbelichtet: Verringern Sie die Belichtung</translation>
        </message>
        <message>
            <source>the picture is dark (mean {brightness:.0f} of 255): more light</source>
            <translation type="unfinished">das Bild ist dunkel (Mittelwert {brightness:.0f} von 255): mehr Licht</translation>
        </message>
        <message>
            <source>the picture is noisy ({noise:.0f} grey values where it is even): more light, so that the camera amplifies less, or a longer exposure</source>
            <translation type="unfinished">das Bild rauscht ({noise:.0f} Grauwerte, wo es gleichmäßig ist): mehr Licht, damit die Kamera weniger verstärkt, oder eine längere Belichtung</translation>
        </message>
        <message>
            <source>{figures_repeated_share:.0%} of the pictures repeat: lower the rate, or plug the cameras into ports of different USB controllers</source>
            <translation type="unfinished">{figures_repeated_share:.0%} der Bilder wiederholen sich: Verringern Sie die Bildrate, oder schließen Sie die Kameras an verschiedene USB-Controller an</translation>
        </message>
        <message>
            <source>{cameras} cameras have {names} names</source>
            <translation type="unfinished">Kameras: {cameras}, Namen: {names}</translation>
        </message>
        <message>
            <source>the camera is closed</source>
            <translation type="unfinished">die Kamera ist geschlossen</translation>
        </message>
        <message>
            <source>the camera was closed</source>
            <translation type="unfinished">die Kamera wurde geschlossen</translation>
        </message>
        <message>
            <source>no picture for {seconds:g} s; check the camera's cable</source>
            <translation type="unfinished">seit {seconds:g} s kein Bild; prüfen Sie das Kabel der Kamera</translation>
        </message>
        <message>
            <source>{node} cannot be opened; another program may use it, or the group `video` is missing</source>
            <translation type="unfinished">{node} lässt sich nicht öffnen; vielleicht benutzt ein anderes Programm die Kamera, oder die Gruppe `video` fehlt</translation>
        </message>
        <message>
            <source>{node} stopped delivering; was it unplugged?</source>
            <translation type="unfinished">{node} liefert nichts mehr; wurde die Kamera ausgesteckt?</translation>
        </message>
        <message>
            <source>{broken} pictures of {node} could not be decoded</source>
            <translation type="unfinished">Bilder von {node}, die sich nicht dekodieren ließen: {broken}</translation>
        </message>
        <message>
            <source>the driver of usb:{place} hangs in its last stream; unplug the camera</source>
            <translation type="unfinished">der Treiber von usb:{place} hängt in seiner letzten Übertragung; stecken Sie die Kamera aus</translation>
        </message>
        <message>
            <source>camera usb:{place} is not open; call open() first</source>
            <translation type="unfinished">die Kamera usb:{place} ist nicht geöffnet; rufen Sie zuerst open() auf</translation>
        </message>
        <message>
            <source>the picture is {plain}; look at the lens cap, the light, the exposure</source>
            <translation type="unfinished">das Bild ist {plain}; sehen Sie nach Objektivdeckel, Licht und Belichtung</translation>
        </message>
        <message>
            <source>the picture does not change any more; plug the camera in again</source>
            <translation type="unfinished">das Bild ändert sich nicht mehr; stecken Sie die Kamera neu ein</translation>
        </message>
        <message>
            <source>no picture for {age:.1f} s{refused}: this computer is too busy to draw them; close other programs</source>
            <translation type="unfinished">seit {age:.1f} s kein Bild{refused}: Dieser Computer ist zu ausgelastet, um sie zu zeichnen; schließen Sie andere Programme</translation>
        </message>
        <message>
            <source>no picture for {age:.1f} s{refused}; check its cable</source>
            <translation type="unfinished">seit {age:.1f} s kein Bild{refused}; prüfen Sie das Kabel</translation>
        </message>
        <message>
            <source>its capture times cannot be used: {intake_figures_text}</source>
            <translation type="unfinished">die Aufnahmezeiten sind nicht verwendbar: {intake_figures_text}</translation>
        </message>
        <message>
            <source>the needle bends: up to {size_mm:.1f} mm off its line at the band</source>
            <translation type="unfinished">die Nadel biegt sich: bis zu {size_mm:.1f} mm neben ihrer Linie am Band</translation>
        </message>
        <message>
            <source>the cameras see the needle turned by {turn_deg:.1f}° from the robot's direction: home the robot again, then run the daily check</source>
            <translation type="unfinished">die Kameras sehen die Nadel um {turn_deg:.1f}° gegen die Richtung des Roboters gedreht: Referenzieren Sie den Roboter neu und führen Sie dann die Tageskontrolle durch</translation>
        </message>
        <message>
            <source>the cameras see the needle {rms_mm:.1f} mm beside the robot's line: move it through its whole depth to tell a bent needle from a camera that was moved</source>
            <translation type="unfinished">die Kameras sehen die Nadel {rms_mm:.1f} mm neben der Linie des Roboters: Bewegen Sie sie durch ihre ganze Tiefe, um eine verbogene Nadel von einer bewegten Kamera zu unterscheiden</translation>
        </message>
        <message>
            <source>towards the tip</source>
            <translation type="unfinished">zur Spitze hin</translation>
        </message>
        <message>
            <source>towards the hub</source>
            <translation type="unfinished">zum Ansatz hin</translation>
        </message>
        <message>
            <source>the tip touches known places {slip_mm:.1f} mm from where the cameras see it: the marker has slipped {where}; set it back to its mark</source>
            <translation type="unfinished">die Spitze berührt bekannte Orte {slip_mm:.1f} mm von dort, wo die Kameras sie sehen: Der Marker ist {where} verrutscht; setzen Sie ihn auf seine Marke zurück</translation>
        </message>
        <message>
            <source>the marker's colour {bgr} (blue, green, red) is grey; a marker needs a colour that nothing else has: click on its middle, not on the shaft</source>
            <translation type="unfinished">die Markerfarbe {bgr} (Blau, Grün, Rot) ist grau; ein Marker braucht eine Farbe, die sonst nichts hat: Klicken Sie auf seine Mitte, nicht auf den Schaft</translation>
        </message>
        <message>
            <source>the click at ({u}, {v}) is outside the picture of {width}x{height}</source>
            <translation type="unfinished">der Klick bei ({u}, {v}) liegt außerhalb des Bildes von {width}x{height}</translation>
        </message>
        <message>
            <source>the marker is overexposed where you clicked; lower exposure or light</source>
            <translation type="unfinished">der Marker ist dort überbelichtet, wo Sie geklickt haben; verringern Sie Belichtung oder Licht</translation>
        </message>
        <message>
            <source>the colour at ({u}, {v}) is nearly grey (strength {strongest:.0f}, at least {least_strength:.0f} is needed): click on the middle of the marker</source>
            <translation type="unfinished">die Farbe bei ({u}, {v}) ist fast grau (Stärke {strongest:.0f}, nötig ist mindestens {least_strength:.0f}): Klicken Sie auf die Mitte des Markers</translation>
        </message>
        <message>
            <source>the marker is out of view of the {other} camera</source>
            <translation type="unfinished">der Marker ist für die Kamera {other} nicht zu sehen</translation>
        </message>
        <message>
            <source>{lost}; the {name} camera's pixel has no ray</source>
            <translation type="unfinished">{lost}; der Pixel der Kamera {name} hat keinen Sehstrahl</translation>
        </message>
        <message>
            <source>{lost}, and the {name} camera looks along the needle, within {least_angle_deg:.0f}°: it cannot tell the depth</source>
            <translation type="unfinished">{lost}, und die Kamera {name} blickt auf {least_angle_deg:.0f}° genau entlang der Nadel: Sie kann die Tiefe nicht bestimmen</translation>
        </message>
        <message>
            <source>{lost}; the {name} camera sees it off the needle's line</source>
            <translation type="unfinished">{lost}; die Kamera {name} sieht ihn neben der Linie der Nadel</translation>
        </message>
        <message>
            <source>{lost}; the {name} camera sees it {pixels:.1f} px beside the needle's line</source>
            <translation type="unfinished">{lost}; die Kamera {name} sieht ihn {pixels:.1f} px neben der Linie der Nadel</translation>
        </message>
        <message>
            <source>{lost}: depth by the {name} camera and the needle's line</source>
            <translation type="unfinished">{lost}: Tiefe aus der Kamera {name} und der Linie der Nadel</translation>
        </message>
        <message>
            <source>covariance needs {size} rows of {size} numbers, in the order {names}</source>
            <translation type="unfinished">covariance braucht {size} Zeilen mit {size} Zahlen, in der Reihenfolge {names}</translation>
        </message>
        <message>
            <source>ray_sd_px needs {rows} rows of {columns} numbers</source>
            <translation type="unfinished">ray_sd_px braucht {rows} Zeilen mit {columns} Zahlen</translation>
        </message>
        <message>
            <source>estimated names {unknown}; there are {names}</source>
            <translation type="unfinished">estimated nennt {unknown}; vorhanden sind {names}</translation>
        </message>
        <message>
            <source>distortion: {given_numbers} numbers; lens {lens} has {needed_numbers}: </source>
            <translation type="unfinished">distortion: {given_numbers} Zahlen; das Objektiv {lens} hat {needed_numbers}: </translation>
        </message>
        <message>
            <source>joint_covariance needs {size} rows of {size} numbers: left, right, pose</source>
            <translation type="unfinished">joint_covariance braucht {size} Zeilen mit {size} Zahlen: links, rechts, Lage</translation>
        </message>
        <message>
            <source>world_by_cameras needs 6 rows of {size} numbers: left, right, pose</source>
            <translation type="unfinished">world_by_cameras braucht 6 Zeilen mit {size} Zahlen: links, rechts, Lage</translation>
        </message>
        <message>
            <source>camera {name}: distortion {distortion}: no lens has a coefficient beyond {wildest:g}; calibrate the camera again</source>
            <translation type="unfinished">Kamera {name}: distortion {distortion}: Kein Objektiv hat einen Koeffizienten jenseits von {wildest:g}; kalibrieren Sie die Kamera neu</translation>
        </message>
        <message>
            <source>camera {name}: focal lengths {intrinsics} px and image size {image_size} must be positive, the size at least 16 px</source>
            <translation type="unfinished">Kamera {name}: Die Brennweiten {intrinsics} px und die Bildgröße {image_size} müssen positiv sein, die Größe mindestens 16 px</translation>
        </message>
        <message>
            <source>{count} coefficients: {distortion_brown}, {distortion_rational} (rational with thin prism) or {distortion_fisheye} (fisheye) are possible</source>
            <translation type="unfinished">Koeffizienten: {count}; möglich sind {distortion_brown}, {distortion_rational} (rational mit dünnem Prisma) oder {distortion_fisheye} (Fischauge)</translation>
        </message>
        <message>
            <source>camera {name}: looks_at_mm {looks_at_mm} lies straight above, below or at position_mm {position_mm}; move it sideways: the roll needs that</source>
            <translation type="unfinished">Kamera {name}: looks_at_mm {looks_at_mm} liegt genau über, unter oder auf position_mm {position_mm}; verschieben Sie es zur Seite: Die Drehung um die Blickachse braucht das</translation>
        </message>
        <message>
            <source>hidden_mm {hidden_mm} must name the smaller depth first, or be left out where nothing hides the band</source>
            <translation type="unfinished">hidden_mm {hidden_mm} muss die kleinere Tiefe zuerst nennen oder wegbleiben, wo nichts das Band verdeckt</translation>
        </message>
        <message>
            <source>second_marker_offset_mm {second} must lie between {least} (half a band's length of bare shaft behind the first) and the needle's length of {length_mm}</source>
            <translation type="unfinished">second_marker_offset_mm {second} muss zwischen {least} (eine halbe Bandlänge blanker Schaft hinter dem ersten) und der Nadellänge von {length_mm} liegen</translation>
        </message>
        <message>
            <source>calibration {calibration_id} has no world frame; lay the board at its known place and run `acus calibrate world`</source>
            <translation type="unfinished">die Kalibrierung {calibration_id} hat kein Weltsystem; legen Sie die Tafel an ihren bekannten Ort und führen Sie `acus calibrate world` aus</translation>
        </message>
        <message>
            <source>calibration {calibration_id} is of the cameras {names}; rig {name} has {wanted}</source>
            <translation type="unfinished">die Kalibrierung {calibration_id} gehört zu den Kameras {names}; der Kameraaufbau {name} hat {wanted}</translation>
        </message>
        <message>
            <source>no camera rig is called {name_or_path!r}; there are {names}, or give the path of a .yaml file</source>
            <translation type="unfinished">kein Kameraaufbau heißt {name_or_path!r}; vorhanden sind {names}, oder geben Sie den Pfad einer .yaml-Datei an</translation>
        </message>
        <message>
            <source>{name} sees nothing of it: the camera looks another way</source>
            <translation type="unfinished">{name} sieht nichts davon: Die Kamera blickt in eine andere Richtung</translation>
        </message>
        <message>
            <source>part of it at {ranges}</source>
            <translation type="unfinished">einen Teil davon bei {ranges}</translation>
        </message>
        <message>
            <source>{name} loses {texts} mm depth</source>
            <translation type="unfinished">{name} verliert {texts} mm Tiefe</translation>
        </message>
        <message>
            <source>the range ends at {reach_depth_max_mm:g} mm, above its beginning at {reach_depth_min_mm:g} mm; swap depth_min_mm and depth_max_mm</source>
            <translation type="unfinished">der Bereich endet bei {reach_depth_max_mm:g} mm, über seinem Anfang bei {reach_depth_min_mm:g} mm; tauschen Sie depth_min_mm und depth_max_mm</translation>
        </message>
        <message>
            <source>the {name} has the marker ids {ids}; each must stand once</source>
            <translation type="unfinished">{name} hat die Marker-IDs {ids}; jede darf nur einmal vorkommen</translation>
        </message>
        <message>
            <source>the {name} needs marker {marker_number}; {dictionary} has 0 to {largest_number}</source>
            <translation type="unfinished">{name} braucht den Marker {marker_number}; {dictionary} hat 0 bis {largest_number}</translation>
        </message>
        <message>
            <source>no ArUco dictionary is called {name!r}; usual is DICT_4X4_50</source>
            <translation type="unfinished">kein ArUco-Wörterbuch heißt {name!r}; üblich ist DICT_4X4_50</translation>
        </message>
        <message>
            <source>an id stands on cube and sheet; give the sheet another first_id</source>
            <translation type="unfinished">eine ID steht auf Würfel und Blatt; geben Sie dem Blatt eine andere first_id</translation>
        </message>
        <message>
            <source>marker_mm {marker_mm:g} leaves {quiet:.1f} mm of white on an edge of {edge_mm:g} mm; {needed:.1f} mm are needed</source>
            <translation type="unfinished">marker_mm {marker_mm:g} lässt auf einer Kante von {edge_mm:g} mm nur {quiet:.1f} mm Weiß; nötig sind {needed:.1f} mm</translation>
        </message>
        <message>
            <source>top needs 4 sides, not {sides}</source>
            <translation type="unfinished">top braucht 4 Seiten, nicht {sides}</translation>
        </message>
        <message>
            <source>cube and sheet need one dictionary</source>
            <translation type="unfinished">Würfel und Blatt brauchen ein gemeinsames Wörterbuch</translation>
        </message>
        <message>
            <source>no pen is called {name_or_path!r}; there are {shipped_pens}, or give the path of a .yaml file</source>
            <translation type="unfinished">kein Stift heißt {name_or_path!r}; vorhanden sind {shipped_pens}, oder geben Sie den Pfad einer .yaml-Datei an</translation>
        </message>
        <message>
            <source>the tip lies {length_mm:.0f} mm from the middle of the cube; 20 mm are the least from which its direction can be told</source>
            <translation type="unfinished">die Spitze liegt {length_mm:.0f} mm von der Mitte des Würfels; erst ab 20 mm lässt sich ihre Richtung bestimmen</translation>
        </message>
        <message>
            <source>{poses} poses are too few to find the shaft; roll on until there are {fewest}</source>
            <translation type="unfinished">{poses} Stellungen sind zu wenige, um den Schaft zu finden; rollen Sie weiter, bis es {fewest} sind</translation>
        </message>
        <message>
            <source>the pen was rolled too little: roll it by a quarter turn or more about its own axis, lying in a groove</source>
            <translation type="unfinished">der Stift wurde zu wenig gerollt: Rollen Sie ihn um eine Vierteldrehung oder mehr um die eigene Achse, in einer Rille liegend</translation>
        </message>
        <message>
            <source>the shaft did not keep its direction while it was rolled: lay it into a groove, for instance between two books, and roll it there</source>
            <translation type="unfinished">der Schaft behielt beim Rollen seine Richtung nicht bei: Legen Sie ihn in eine Rille, etwa zwischen zwei Bücher, und rollen Sie ihn dort</translation>
        </message>
        <message>
            <source>on {poses} positions held back the tip was {rms_mm:.2f} mm from its dimple (at most {worst_mm:.1f} mm)</source>
            <translation type="unfinished">bei zurückgehaltenen Stellungen ({poses}) lag die Spitze {rms_mm:.2f} mm neben ihrer Mulde (höchstens {worst_mm:.1f} mm)</translation>
        </message>
        <message>
            <source>tip at ({x:.1f}, {y:.1f}, {z:.1f}) mm from the middle of the cube, standard deviation {tip_sd_mm:.2f} mm; it stood still to {tip_rms_mm:.2f} mm in {tip_poses} poses ({tip_left_out} left out); axis to {axis_sd_deg:.2f}°</source>
            <translation type="unfinished">Spitze bei ({x:.1f}, {y:.1f}, {z:.1f}) mm von der Mitte des Würfels, Standardabweichung {tip_sd_mm:.2f} mm; sie stand auf {tip_rms_mm:.2f} mm still, Stellungen: {tip_poses} (ausgelassen: {tip_left_out}); Achse auf {axis_sd_deg:.2f}°</translation>
        </message>
        <message>
            <source>the {name} is seen too flat: two poses {apart_deg:.0f}° apart look the same; turn it so that two faces show, or move the webcam to the side</source>
            <translation type="unfinished">{name} ist zu flach zu sehen: Zwei Lagen im Abstand von {apart_deg:.0f}° sehen gleich aus; drehen Sie so, dass zwei Flächen zu sehen sind, oder stellen Sie die Webcam zur Seite</translation>
        </message>
        <message>
            <source>tip within ± {tip_radius_mm:.1f} mm (95 %), axis within ± {axis_cone_deg:.1f}°</source>
            <translation type="unfinished">Spitze auf ± {tip_radius_mm:.1f} mm (95 %), Achse auf ± {axis_cone_deg:.1f}°</translation>
        </message>
        <message>
            <source>the {name} needs {wide:.0f} x {high:.0f} mm and does not fit on {paper_name}; take larger paper or smaller faces in the pen's profile</source>
            <translation type="unfinished">{name} braucht {wide:.0f} x {high:.0f} mm und passt nicht auf {paper_name}; nehmen Sie größeres Papier oder kleinere Flächen im Profil des Stifts</translation>
        </message>
        <message>
            <source>{poses} poses are too few to find the tip; rock the pen until there are {fewest}</source>
            <translation type="unfinished">{poses} Stellungen sind zu wenige, um die Spitze zu finden; schwenken Sie den Stift, bis es {fewest} sind</translation>
        </message>
        <message>
            <source>the pen was held still: rock it by 30° to every side with its tip in the dimple</source>
            <translation type="unfinished">der Stift wurde still gehalten: Schwenken Sie ihn um 30° nach allen Seiten, mit der Spitze in der Mulde</translation>
        </message>
        <message>
            <source>the pen was {how}: the tip's place along that axis stays open; rock it by 30° to every side with its tip in the dimple</source>
            <translation type="unfinished">der Stift wurde {how}: Der Ort der Spitze entlang dieser Achse bleibt offen; schwenken Sie ihn um 30° nach allen Seiten, mit der Spitze in der Mulde</translation>
        </message>
        <message>
            <source>{contradicting} of {poses} poses contradict the others: the tip slipped; press it into the dimple and rock again</source>
            <translation type="unfinished">{contradicting} von {poses} Stellungen widersprechen den anderen: Die Spitze ist verrutscht; drücken Sie sie in die Mulde und schwenken Sie noch einmal</translation>
        </message>
        <message>
            <source>the tip is known to {result_sd_mm:.1f} mm only (standard deviation), the limit is {largest_sd_mm:.0f} mm: rock it further, nearer to the webcam</source>
            <translation type="unfinished">die Spitze ist nur auf {result_sd_mm:.1f} mm bekannt (Standardabweichung), die Grenze ist {largest_sd_mm:.0f} mm: Schwenken Sie weiter, näher an der Webcam</translation>
        </message>
        <message>
            <source>{path} has no camera {camera!r}; there are {names}</source>
            <translation type="unfinished">{path} hat keine Kamera {camera!r}; vorhanden sind {names}</translation>
        </message>
        <message>
            <source>the picture is mirrored: switch mirroring off in the webcam's own settings</source>
            <translation type="unfinished">das Bild ist gespiegelt: Schalten Sie die Spiegelung in den Einstellungen der Webcam aus</translation>
        </message>
        <message>
            <source>marker {marker_number} is in view twice: two pens, or a mirror; take one away</source>
            <translation type="unfinished">der Marker {marker_number} ist zweimal zu sehen: zwei Stifte oder ein Spiegel; nehmen Sie einen davon weg</translation>
        </message>
        <message>
            <source>; it is cut off, covered or too small</source>
            <translation type="unfinished">; abgeschnitten, verdeckt oder zu klein</translation>
        </message>
        <message>
            <source>the {name} is out of view{reason}</source>
            <translation type="unfinished">{name} ist nicht zu sehen{reason}</translation>
        </message>
        <message>
            <source>the sheet is out of view, so the webcam's place is not known; show both</source>
            <translation type="unfinished">das Blatt ist nicht zu sehen, daher ist der Ort der Webcam nicht bekannt; zeigen Sie beide</translation>
        </message>
        <message>
            <source>the pictures are {picture_width}x{picture_height}, the calibration is of {calibrated_width}x{calibrated_height}; set the webcam to that size or calibrate it anew (`acus calibrate mono`)</source>
            <translation type="unfinished">die Bilder haben {picture_width}x{picture_height}, die Kalibrierung {calibrated_width}x{calibrated_height}; stellen Sie die Webcam auf diese Größe ein oder kalibrieren Sie sie neu (`acus calibrate mono`)</translation>
        </message>
        <message>
            <source>THE LENS IS GUESSED from the size of the picture: calibrate it with `acus calibrate mono`, the needle is several times less certain until then</source>
            <translation type="unfinished">DAS OBJEKTIV IST aus der Bildgröße GESCHÄTZT: Kalibrieren Sie es mit `acus calibrate mono`, bis dahin ist die Nadel um ein Mehrfaches unsicherer</translation>
        </message>
        <message>
            <source>lens calibrated ({calibration_views} views, {calibration_rms_px:.2f} px)</source>
            <translation type="unfinished">Objektiv kalibriert (Aufnahmen: {calibration_views}, {calibration_rms_px:.2f} px)</translation>
        </message>
        <message>
            <source>is no picture: {error_err}</source>
            <translation type="unfinished">ist kein Bild: {error_err}</translation>
        </message>
        <message>
            <source>is no picture or is damaged</source>
            <translation type="unfinished">ist kein Bild oder ist beschädigt</translation>
        </message>
        <message>
            <source>has more than {side} x {side} pixels, which are the most: make it smaller, or take it out of the folder</source>
            <translation type="unfinished">hat mehr als die höchstens möglichen {side} x {side} Pixel: Verkleinern Sie das Bild, oder nehmen Sie es aus dem Ordner</translation>
        </message>
        <message>
            <source>there is no folder {path}</source>
            <translation type="unfinished">es gibt keinen Ordner {path}</translation>
        </message>
        <message>
            <source>camera {renderer_model_name} is not open; call open() first</source>
            <translation type="unfinished">die Kamera {renderer_model_name} ist nicht geöffnet; rufen Sie zuerst open() auf</translation>
        </message>
        <message>
            <source>a tone curve needs linear light (uint16), got a picture of {light_dtype}; build the renderer with light=True</source>
            <translation type="unfinished">eine Tonwertkurve braucht lineares Licht (uint16), bekam aber ein Bild mit {light_dtype}; bauen Sie den Renderer mit light=True</translation>
        </message>
        <message>
            <source>OpenCV cannot code a picture of {image_shape} as JPEG</source>
            <translation type="unfinished">OpenCV kann ein Bild der Form {image_shape} nicht als JPEG kodieren</translation>
        </message>
        <message>
            <source>no effect on pictures is called {effect_name!r}; there are {by_name}</source>
            <translation type="unfinished">kein Effekt auf Bilder heißt {effect_name!r}; vorhanden sind {by_name}</translation>
        </message>
        <message>
            <source>a pixel has no ray</source>
            <translation type="unfinished">ein Pixel hat keinen Sehstrahl</translation>
        </message>
        <message>
            <source>the rays are {status}</source>
            <translation type="unfinished">Zustand der Sehstrahlen: {status}</translation>
        </message>
        <message>
            <source>the pictures disagree by {residual:.1f} px: two red things, or a moved camera</source>
            <translation type="unfinished">die Bilder weichen um {residual:.1f} px voneinander ab: zwei rote Dinge oder eine bewegte Kamera</translation>
        </message>
        <message>
            <source>the marker seems {distance:.1f} mm beside the needle's line</source>
            <translation type="unfinished">der Marker scheint {distance:.1f} mm neben der Linie der Nadel zu liegen</translation>
        </message>
        <message>
            <source>{as_set_px:.1f} px as set, {swapped_px:.1f} px exchanged</source>
            <translation type="unfinished">{as_set_px:.1f} px wie eingestellt, {swapped_px:.1f} px vertauscht</translation>
        </message>
        <message>
            <source>the cameras are swapped ({figures}): exchange left and right in the settings</source>
            <translation type="unfinished">die Kameras sind vertauscht ({figures}): Tauschen Sie links und rechts in den Einstellungen</translation>
        </message>
        <message>
            <source>left and right are as calibrated ({figures})</source>
            <translation type="unfinished">links und rechts sind wie kalibriert ({figures})</translation>
        </message>
        <message>
            <source>left and right could not be checked: both must see the marker</source>
            <translation type="unfinished">links und rechts ließen sich nicht prüfen: Beide Kameras müssen den Marker sehen</translation>
        </message>
        <message>
            <source>the pictures fit in neither order ({figures}): calibrate again, a camera was moved or another one plugged in</source>
            <translation type="unfinished">die Bilder passen in keiner Reihenfolge ({figures}): Kalibrieren Sie neu, eine Kamera wurde bewegt oder eine andere angeschlossen</translation>
        </message>
        <message>
            <source>left and right could not be told apart ({figures}): move the needle sideways, and deeper or further out</source>
            <translation type="unfinished">links und rechts ließen sich nicht unterscheiden ({figures}): Bewegen Sie die Nadel seitwärts und tiefer oder weiter heraus</translation>
        </message>
        <message>
            <source>the marker is out of view of the {name} camera</source>
            <translation type="unfinished">der Marker ist für die Kamera {name} nicht zu sehen</translation>
        </message>
        <message>
            <source>the {name} camera does not measure the marker ({reason})</source>
            <translation type="unfinished">die Kamera {name} misst den Marker nicht ({reason})</translation>
        </message>
        <message>
            <source>the tracker needs two cameras, got {cameras}</source>
            <translation type="unfinished">der Tracker braucht zwei Kameras, bekam {cameras}</translation>
        </message>
        <message>
            <source>a step of the tracker needs at least one picture</source>
            <translation type="unfinished">ein Schritt des Trackers braucht mindestens ein Bild</translation>
        </message>
        <message>
            <source>the pictures' capture times run backwards</source>
            <translation type="unfinished">die Aufnahmezeiten der Bilder laufen rückwärts</translation>
        </message>
        <message>
            <source>camera {camera!r} has given no picture; there are {names}</source>
            <translation type="unfinished">die Kamera {camera!r} hat kein Bild geliefert; vorhanden sind {names}</translation>
        </message>
        <message>
            <source>{share:.1f} % of the ticks come too late</source>
            <translation type="unfinished">{share:.1f} % der Takte kommen zu spät</translation>
        </message>
        <message>
            <source>a tick takes {us:.0f} µs of {period:.0f} µs</source>
            <translation type="unfinished">ein Takt braucht {us:.0f} µs von {period:.0f} µs</translation>
        </message>
        <message>
            <source>{what}: no effect of this scene is the reason; close other programs, or use a faster computer</source>
            <translation type="unfinished">{what}: Kein Effekt dieser Szene ist der Grund; schließen Sie andere Programme oder nehmen Sie einen schnelleren Computer</translation>
        </message>
        <message>
            <source>{what}: compute “{title}” by {model}, which saves {us:.1f} µs a tick</source>
            <translation type="unfinished">{what}: Berechnen Sie „{title}“ mit {model}, das spart {us:.1f} µs je Takt</translation>
        </message>
        <message>
            <source>{ns:.0f} ns</source>
            <translation type="unfinished">{ns:.0f} ns</translation>
        </message>
        <message>
            <source>{us:.2f} µs</source>
            <translation type="unfinished">{us:.2f} µs</translation>
        </message>
        <message>
            <source>Processor time of one call</source>
            <translation type="unfinished">Rechenzeit eines Aufrufs</translation>
        </message>
        <message>
            <source>in use</source>
            <translation type="unfinished">verwendet</translation>
        </message>
        <message>
            <source>by the rule</source>
            <translation type="unfinished">nach der Regel</translation>
        </message>
        <message>
            <source>Effects</source>
            <translation type="unfinished">Effekte</translation>
        </message>
        <message>
            <source>&amp;Checks</source>
            <translation type="unfinished">&amp;Kontrollen</translation>
        </message>
        <message>
            <source>Cost of accuracy…</source>
            <translation type="unfinished">Kosten der Genauigkeit…</translation>
        </message>
        <message>
            <source>{effect} is computed by {model}</source>
            <translation type="unfinished">{effect} wird mit {model} berechnet</translation>
        </message>
        <message>
            <source>Trying hard cases</source>
            <translation type="unfinished">Schwierige Fälle werden durchgerechnet</translation>
        </message>
        <message>
            <source>Measuring on this computer</source>
            <translation type="unfinished">Messung auf diesem Computer</translation>
        </message>
        <message>
            <source>End the attempt first: measuring takes processor time from it</source>
            <translation type="unfinished">Beenden Sie zuerst den Versuch: Die Messung nähme ihm Rechenzeit weg</translation>
        </message>
        <message>
            <source>Something is being measured already: wait, or cancel it at the top</source>
            <translation type="unfinished">Es wird schon etwas gemessen: Warten Sie oder brechen Sie es oben ab</translation>
        </message>
        <message>
            <source>Where a formula is delicate: what is right there, how far off the program is, how far off it may be, and what happens one step beyond.</source>
            <translation type="unfinished">Wo eine Formel heikel ist: was dort richtig ist, wie weit das Programm abweicht, wie weit es abweichen darf und was einen Schritt weiter geschieht.</translation>
        </message>
        <message>
            <source>Try them all</source>
            <translation type="unfinished">Alle durchrechnen</translation>
        </message>
        <message>
            <source>Subsystem</source>
            <translation type="unfinished">Teilsystem</translation>
        </message>
        <message>
            <source>Case</source>
            <translation type="unfinished">Fall</translation>
        </message>
        <message>
            <source>Error</source>
            <translation type="unfinished">Fehler</translation>
        </message>
        <message>
            <source>Bound</source>
            <translation type="unfinished">Schranke</translation>
        </message>
        <message>
            <source>Unit</source>
            <translation type="unfinished">Einheit</translation>
        </message>
        <message>
            <source>Beyond the bound</source>
            <translation type="unfinished">Jenseits der Schranke</translation>
        </message>
        <message>
            <source>Holds</source>
            <translation type="unfinished">Hält</translation>
        </message>
        <message>
            <source>{times:.3g} times</source>
            <translation type="unfinished">{times:.3g}-fach</translation>
        </message>
        <message>
            <source>{percent:.0f} %</source>
            <translation type="unfinished">{percent:.0f} %</translation>
        </message>
        <message>
            <source>{percent:.2g} %</source>
            <translation type="unfinished">{percent:.2g} %</translation>
        </message>
        <message>
            <source>Measured with this version</source>
            <translation type="unfinished">Mit dieser Version gemessen</translation>
        </message>
        <message>
            <source>Measured on this computer</source>
            <translation type="unfinished">Auf diesem Computer gemessen</translation>
        </message>
        <message>
            <source>Ratios hold on every computer, seconds do not</source>
            <translation type="unfinished">Verhältnisse gelten auf jedem Computer, Sekunden nicht</translation>
        </message>
        <message>
            <source>Measure on this computer</source>
            <translation type="unfinished">Auf diesem Computer messen</translation>
        </message>
        <message>
            <source>Way</source>
            <translation type="unfinished">Verfahren</translation>
        </message>
        <message>
            <source>Largest error</source>
            <translation type="unfinished">Größter Fehler</translation>
        </message>
        <message>
            <source>Share of what can be noticed</source>
            <translation type="unfinished">Anteil am Merkbaren</translation>
        </message>
        <message>
            <source>Time</source>
            <translation type="unfinished">Zeit</translation>
        </message>
        <message>
            <source>Verdict</source>
            <translation type="unfinished">Urteil</translation>
        </message>
        <message>
            <source>Back</source>
            <translation type="unfinished">Zurück</translation>
        </message>
        <message>
            <source>Cost of accuracy</source>
            <translation type="unfinished">Kosten der Genauigkeit</translation>
        </message>
        <message>
            <source>Choices</source>
            <translation type="unfinished">Auswahl</translation>
        </message>
        <message>
            <source>Hard cases</source>
            <translation type="unfinished">Schwierige Fälle</translation>
        </message>
        <message>
            <source>Something is being measured: wait, or cancel it at the top</source>
            <translation type="unfinished">Es wird etwas gemessen: Warten Sie oder brechen Sie es oben ab</translation>
        </message>
        <message>
            <source>No answer: {ways}</source>
            <translation type="unfinished">Keine Antwort: {ways}</translation>
        </message>
        <message>
            <source>Measured {date}, version {version}.</source>
            <translation type="unfinished">Gemessen am {date}, Version {version}.</translation>
        </message>
        <message>
            <source>In use: {name}. Exception: {why} {when}</source>
            <translation type="unfinished">Verwendet: {name}. Ausnahme: {why} {when}</translation>
        </message>
        <message>
            <source>the cheapest method in time whose error goes unnoticed</source>
            <translation type="unfinished">das günstigste rechtzeitige Verfahren, dessen Fehler man nicht merkt</translation>
        </message>
        <message>
            <source>In use: {name}, {words}. {when}</source>
            <translation type="unfinished">Verwendet: {name}, {words}. {when}</translation>
        </message>
        <message>
            <source>noticed</source>
            <translation type="unfinished">merkbar</translation>
        </message>
        <message>
            <source>too slow</source>
            <translation type="unfinished">zu langsam</translation>
        </message>
        <message>
            <source>keeps both limits</source>
            <translation type="unfinished">hält beide Grenzen ein</translation>
        </message>
        <message>
            <source>{what} {taken:.1f} of {period:.0f} ms ({share:.0f} %)</source>
            <translation type="unfinished">{what} {taken:.1f} von {period:.0f} ms ({share:.0f} %)</translation>
        </message>
        <message>
            <source>Acts on the cameras' pictures: nothing of a tick; chosen before it begins</source>
            <translation type="unfinished">Wirkt auf die Kamerabilder: kostet nichts vom Takt; wird vor dem Beginn gewählt</translation>
        </message>
        <message>
            <source>By which model it is computed, and its time in a tick on this computer; another one applies at once</source>
            <translation type="unfinished">Mit welchem Modell er berechnet wird und wie viel Zeit er auf diesem Computer in einem Takt braucht; ein anderes gilt sofort</translation>
        </message>
        <message>
            <source>No exercise runs: begin one to see what it simulates.</source>
            <translation type="unfinished">Es läuft keine Übung: Beginnen Sie eine, um zu sehen, was sie simuliert.</translation>
        </message>
        <message>
            <source>Lower it</source>
            <translation type="unfinished">Senken</translation>
        </message>
        <message>
            <source>Computes the effect that costs most by its cheapest model, at once</source>
            <translation type="unfinished">Berechnet den teuersten Effekt sofort mit seinem günstigsten Modell</translation>
        </message>
        <message>
            <source>Error against time of every choice in the program</source>
            <translation type="unfinished">Fehler und Zeit jeder Wahlmöglichkeit im Programm</translation>
        </message>
        <message>
            <source>A frame of the window takes</source>
            <translation type="unfinished">Ein Bild des Fensters braucht</translation>
        </message>
        <message>
            <source>From the newest state of the needle until all that shows it is painted</source>
            <translation type="unfinished">Vom neuesten Zustand der Nadel, bis alles gezeichnet ist, was ihn zeigt</translation>
        </message>
        <message>
            <source>A pair of pictures takes</source>
            <translation type="unfinished">Ein Bildpaar braucht</translation>
        </message>
        <message>
            <source>Finding the marker in both cameras' pictures and the needle from it</source>
            <translation type="unfinished">Den Marker in den Bildern beider Kameras finden und daraus die Nadel</translation>
        </message>
        <message>
            <source>This scene has no effects.</source>
            <translation type="unfinished">Diese Szene hat keine Effekte.</translation>
        </message>
        <message>
            <source>A tick takes {tick} of {period:.0f} µs ({share:.1f} %); {effects} of it for effects</source>
            <translation type="unfinished">Ein Takt braucht {tick} von {period:.0f} µs ({share:.1f} %); davon {effects} für Effekte</translation>
        </message>
        <message>
            <source>held at {rate:.0f} Hz on this computer</source>
            <translation type="unfinished">auf diesem Computer bei {rate:.0f} Hz gehalten</translation>
        </message>
        <message>
            <source>Bone is in the way at {depth:.0f} mm, before the target at {length:.0f} mm: no needle reaches it. Choose another entry.</source>
            <translation type="unfinished">Bei {depth:.0f} mm ist Knochen im Weg, vor dem Ziel bei {length:.0f} mm: Keine Nadel erreicht es. Wählen Sie einen anderen Einstichpunkt.</translation>
        </message>
        <message>
            <source>Exercise</source>
            <translation type="unfinished">Übung</translation>
        </message>
        <message>
            <source>Undo</source>
            <translation type="unfinished">Rückgängig</translation>
        </message>
        <message>
            <source>Redo</source>
            <translation type="unfinished">Wiederholen</translation>
        </message>
        <message>
            <source>Duplicate</source>
            <translation type="unfinished">Duplizieren</translation>
        </message>
        <message>
            <source>Export…</source>
            <translation type="unfinished">Exportieren…</translation>
        </message>
        <message>
            <source>Try at once</source>
            <translation type="unfinished">Gleich testen</translation>
        </message>
        <message>
            <source>Keep</source>
            <translation type="unfinished">Speichern</translation>
        </message>
        <message>
            <source>the trial ended without an answer</source>
            <translation type="unfinished">der Testlauf endete ohne Antwort</translation>
        </message>
        <message>
            <source>Plan</source>
            <translation type="unfinished">Plan</translation>
        </message>
        <message>
            <source>&amp;File</source>
            <translation type="unfinished">&amp;Datei</translation>
        </message>
        <message>
            <source>Make an exercise from the open patient…</source>
            <translation type="unfinished">Übung aus dem offenen Patienten machen…</translation>
        </message>
        <message>
            <source>Change the present exercise…</source>
            <translation type="unfinished">Aktuelle Übung ändern…</translation>
        </message>
        <message>
            <source>Import an exercise…</source>
            <translation type="unfinished">Übung importieren…</translation>
        </message>
        <message>
            <source>Export the present exercise…</source>
            <translation type="unfinished">Aktuelle Übung exportieren…</translation>
        </message>
        <message>
            <source>without a title</source>
            <translation type="unfinished">ohne Titel</translation>
        </message>
        <message>
            <source>the exercise “{title}”, which is not kept yet</source>
            <translation type="unfinished">die Übung „{title}“, die noch nicht gespeichert ist</translation>
        </message>
        <message>
            <source>Exercise not kept</source>
            <translation type="unfinished">Übung nicht gespeichert</translation>
        </message>
        <message>
            <source>Keep {what}?</source>
            <translation type="unfinished">Speichern: {what}?</translation>
        </message>
        <message>
            <source>There is no CT open to make an exercise of: open one first.</source>
            <translation type="unfinished">Es ist kein CT offen, aus dem eine Übung werden könnte: Öffnen Sie zuerst eines.</translation>
        </message>
        <message>
            <source>No exercise is open: choose one first.</source>
            <translation type="unfinished">Keine Übung ist offen: Wählen Sie zuerst eine.</translation>
        </message>
        <message>
            <source>{title} (copy)</source>
            <translation type="unfinished">{title} (Kopie)</translation>
        </message>
        <message>
            <source>Exercises that come with Acus stay as they are: this is a copy.</source>
            <translation type="unfinished">Mitgelieferte Übungen bleiben, wie sie sind: Dies ist eine Kopie.</translation>
        </message>
        <message>
            <source>There is no target in the window yet: press T, then click.</source>
            <translation type="unfinished">Im Fenster ist noch kein Ziel: Drücken Sie T und klicken Sie dann.</translation>
        </message>
        <message>
            <source>Path and position taken from the window.</source>
            <translation type="unfinished">Pfad und Patientenlage aus dem Fenster übernommen.</translation>
        </message>
        <message>
            <source>It takes a CT that is open, and an exercise without mistakes.</source>
            <translation type="unfinished">Dazu braucht es ein offenes CT und eine Übung ohne Fehler.</translation>
        </message>
        <message>
            <source>{count} layers along the path: {names}</source>
            <translation type="unfinished">Gewebeschichten entlang des Pfads: {count} ({names})</translation>
        </message>
        <message>
            <source>Window and slab taken from the axial pane.</source>
            <translation type="unfinished">Fensterung und Slab aus der axialen Ansicht übernommen.</translation>
        </message>
        <message>
            <source>This is a copy now; the exercise that it was made of stays as it is.</source>
            <translation type="unfinished">Dies ist jetzt eine Kopie; die ursprüngliche Übung bleibt, wie sie ist.</translation>
        </message>
        <message>
            <source>An attempt is running: end it first.</source>
            <translation type="unfinished">Ein Versuch läuft: Beenden Sie ihn zuerst.</translation>
        </message>
        <message>
            <source>The exercise is used as it is now; this does not save it.</source>
            <translation type="unfinished">Die Übung wird so verwendet, wie sie jetzt ist; gespeichert wird sie dadurch nicht.</translation>
        </message>
        <message>
            <source>The exercise is now in use.</source>
            <translation type="unfinished">Die Übung wird jetzt verwendet.</translation>
        </message>
        <message>
            <source>Kept as “{name}”, version {n}.</source>
            <translation type="unfinished">Als „{name}“ gespeichert, Version {n}.</translation>
        </message>
        <message>
            <source>Not checked yet: what the patient calls for. The answer comes here.</source>
            <translation type="unfinished">Noch nicht geprüft: was der Patient verlangt. Die Antwort erscheint hier.</translation>
        </message>
        <message>
            <source>It cannot be checked: {reason}</source>
            <translation type="unfinished">Es lässt sich nicht prüfen: {reason}</translation>
        </message>
        <message>
            <source>The patient calls for more: {names}.</source>
            <translation type="unfinished">Der Patient verlangt mehr: {names}.</translation>
        </message>
        <message>
            <source>Checked: the patient calls for nothing more.</source>
            <translation type="unfinished">Geprüft: Der Patient verlangt nichts weiter.</translation>
        </message>
        <message>
            <source>Open the CT of the exercise first: begin it.</source>
            <translation type="unfinished">Öffnen Sie zuerst das CT der Übung: Beginnen Sie sie.</translation>
        </message>
        <message>
            <source>Exercises (*{suffix})</source>
            <translation type="unfinished">Übungen (*{suffix})</translation>
        </message>
        <message>
            <source>Export exercise</source>
            <translation type="unfinished">Übung exportieren</translation>
        </message>
        <message>
            <source>Put the CT into the file, de-identified?
Without it, it can be used where the same CT is.</source>
            <translation type="unfinished">Soll das CT de-identifiziert in die Datei?
Ohne CT lässt sie sich dort verwenden, wo dasselbe CT vorhanden ist.</translation>
        </message>
        <message>
            <source>Exported {name}</source>
            <translation type="unfinished">{name} exportiert</translation>
        </message>
        <message>
            <source>Exporting the exercise</source>
            <translation type="unfinished">Übung wird exportiert</translation>
        </message>
        <message>
            <source>Import exercise</source>
            <translation type="unfinished">Übung importieren</translation>
        </message>
        <message>
            <source>Importing the exercise</source>
            <translation type="unfinished">Übung wird importiert</translation>
        </message>
        <message>
            <source>{file} does not hold its CT: choose the folder of the CT that the exercise was made on</source>
            <translation type="unfinished">{file} enthält sein CT nicht: Wählen Sie den Ordner des CT, mit dem die Übung gemacht wurde</translation>
        </message>
        <message>
            <source>Folder of the exercise's CT</source>
            <translation type="unfinished">Ordner des CT der Übung</translation>
        </message>
        <message>
            <source>There is another exercise of this name.
Yes: keep this one as a new version of it.
No: keep it under another name.</source>
            <translation type="unfinished">Es gibt schon eine andere Übung mit diesem Namen.
Ja: diese als neue Version davon speichern.
Nein: diese unter einem anderen Namen speichern.</translation>
        </message>
        <message>
            <source>The exercise “{title}” was there already.</source>
            <translation type="unfinished">Die Übung „{title}“ war schon da.</translation>
        </message>
        <message>
            <source>The exercise “{title}” is in the list now.</source>
            <translation type="unfinished">Die Übung „{title}“ ist jetzt in der Liste.</translation>
        </message>
        <message>
            <source>five scripted skills are trying it …</source>
            <translation type="unfinished">fünf Skripte verschiedenen Könnens probieren sie aus …</translation>
        </message>
        <message>
            <source>1 attempt of each skill, without structures of risk</source>
            <translation type="unfinished">1 Versuch je Skript, ohne Risikostrukturen</translation>
        </message>
        <message>
            <source>{n} attempts of each skill, without structures of risk</source>
            <translation type="unfinished">{n} Versuche je Skript, ohne Risikostrukturen</translation>
        </message>
        <message>
            <source>more are on their way …</source>
            <translation type="unfinished">weitere folgen …</translation>
        </message>
        <message>
            <source>It cannot be tried: {why}</source>
            <translation type="unfinished">Sie lässt sich nicht testen: {why}</translation>
        </message>
        <message>
            <source>Follow the path</source>
            <translation type="unfinished">Pfad folgen</translation>
        </message>
        <message>
            <source>Plan it yourself</source>
            <translation type="unfinished">Selbst planen</translation>
        </message>
        <message>
            <source>Control scans</source>
            <translation type="unfinished">Kontrollscans</translation>
        </message>
        <message>
            <source>Title</source>
            <translation type="unfinished">Titel</translation>
        </message>
        <message>
            <source>one line for people</source>
            <translation type="unfinished">eine Zeile für Menschen</translation>
        </message>
        <message>
            <source>Type</source>
            <translation type="unfinished">Art</translation>
        </message>
        <message>
            <source>Level (1 easiest)</source>
            <translation type="unfinished">Stufe (1 am leichtesten)</translation>
        </message>
        <message>
            <source>Briefing</source>
            <translation type="unfinished">Einweisung</translation>
        </message>
        <message>
            <source>Practice</source>
            <translation type="unfinished">Training</translation>
        </message>
        <message>
            <source>Assessment: all controls are locked</source>
            <translation type="unfinished">Prüfung: alle Bedienelemente sind gesperrt</translation>
        </message>
        <message>
            <source>Purpose</source>
            <translation type="unfinished">Zweck</translation>
        </message>
        <message>
            <source>Will be kept as “{name}”.</source>
            <translation type="unfinished">Wird als „{name}“ gespeichert.</translation>
        </message>
        <message>
            <source>; changes become the next version</source>
            <translation type="unfinished">; Änderungen werden die nächste Version</translation>
        </message>
        <message>
            <source>Kept as “{name}”, version {n}</source>
            <translation type="unfinished">Als „{name}“ gespeichert, Version {n}</translation>
        </message>
        <message>
            <source>Patient and path</source>
            <translation type="unfinished">Patient und Pfad</translation>
        </message>
        <message>
            <source>Take path and position from the window</source>
            <translation type="unfinished">Pfad und Patientenlage aus dem Fenster übernehmen</translation>
        </message>
        <message>
            <source>Structure</source>
            <translation type="unfinished">Struktur</translation>
        </message>
        <message>
            <source>Of risk</source>
            <translation type="unfinished">Riskant</translation>
        </message>
        <message>
            <source>Keep off [mm]</source>
            <translation type="unfinished">Abstand [mm]</translation>
        </message>
        <message>
            <source>None is drawn: draw or import some on the page Structures.</source>
            <translation type="unfinished">Keine ist eingezeichnet: Zeichnen oder importieren Sie welche auf der Seite Strukturen.</translation>
        </message>
        <message>
            <source>Structures, drawn in the window</source>
            <translation type="unfinished">Im Fenster gezeichnete Strukturen</translation>
        </message>
        <message>
            <source>Needle</source>
            <translation type="unfinished">Nadel</translation>
        </message>
        <message>
            <source>Length of the needle, 0 for the device's own</source>
            <translation type="unfinished">Länge der Nadel, 0 für die des Geräts</translation>
        </message>
        <message>
            <source>Robot</source>
            <translation type="unfinished">Roboter</translation>
        </message>
        <message>
            <source>Ball joint, empty for the robot's own</source>
            <translation type="unfinished">Kugelgelenk, leer für das des Roboters</translation>
        </message>
        <message>
            <source>Cameras</source>
            <translation type="unfinished">Kameras</translation>
        </message>
        <message>
            <source>Organ of the target</source>
            <translation type="unfinished">Organ des Ziels</translation>
        </message>
        <message>
            <source>such as liver</source>
            <translation type="unfinished">etwa liver</translation>
        </message>
        <message>
            <source>Seed of everything random</source>
            <translation type="unfinished">Startwert aller Zufälle</translation>
        </message>
        <message>
            <source>Phantom {n}</source>
            <translation type="unfinished">Phantom {n}</translation>
        </message>
        <message>
            <source>Own CT, digest {digest}…</source>
            <translation type="unfinished">Eigenes CT, Prüfsumme {digest}…</translation>
        </message>
        <message>
            <source>Own CT</source>
            <translation type="unfinished">Eigenes CT</translation>
        </message>
        <message>
            <source>Entry</source>
            <translation type="unfinished">Einstichpunkt</translation>
        </message>
        <message>
            <source>Target</source>
            <translation type="unfinished">Ziel</translation>
        </message>
        <message>
            <source>the student's to place</source>
            <translation type="unfinished">setzt der Teilnehmer</translation>
        </message>
        <message>
            <source>the phantom's lesion</source>
            <translation type="unfinished">Läsion des Phantoms</translation>
        </message>
        <message>
            <source>Position: {name}</source>
            <translation type="unfinished">Lage: {name}</translation>
        </message>
        <message>
            <source>Assistance</source>
            <translation type="unfinished">Unterstützung</translation>
        </message>
        <message>
            <source>Dial at the start: 1 guides, 0 nothing, −1 repels</source>
            <translation type="unfinished">Regler am Anfang: 1 führt, 0 nichts, −1 drückt weg</translation>
        </message>
        <message>
            <source>Fixed: the same at every attempt</source>
            <translation type="unfinished">Fest: bei jedem Versuch gleich</translation>
        </message>
        <message>
            <source>Schedule: a dial for each attempt</source>
            <translation type="unfinished">Ablauf: ein Reglerwert je Versuch</translation>
        </message>
        <message>
            <source>Fading: less after good attempts, more after poor ones</source>
            <translation type="unfinished">Ausschleichend: weniger nach guten, mehr nach schwachen Versuchen</translation>
        </message>
        <message>
            <source>Over the attempts</source>
            <translation type="unfinished">Über die Versuche hinweg</translation>
        </message>
        <message>
            <source>Dials of the 1st, 2nd, … attempt</source>
            <translation type="unfinished">Regler beim 1., 2., … Versuch</translation>
        </message>
        <message>
            <source>Dial never falls below</source>
            <translation type="unfinished">Regler nie kleiner als</translation>
        </message>
        <message>
            <source>Step of the dial</source>
            <translation type="unfinished">Schritt des Reglers</translation>
        </message>
        <message>
            <source>Good from a total of</source>
            <translation type="unfinished">Gut ab Gesamtpunktzahl</translation>
        </message>
        <message>
            <source>Poor below a total of</source>
            <translation type="unfinished">Schwach unter Gesamtpunktzahl</translation>
        </message>
        <message>
            <source>Every so many attempts a probe without help; 0: none</source>
            <translation type="unfinished">Nach so vielen Versuchen ein Testversuch ohne Hilfe; 0: keiner</translation>
        </message>
        <message>
            <source>Force laws</source>
            <translation type="unfinished">Kraftgesetze</translation>
        </message>
        <message>
            <source>What is seen</source>
            <translation type="unfinished">Was zu sehen ist</translation>
        </message>
        <message>
            <source>Views</source>
            <translation type="unfinished">Ansichten</translation>
        </message>
        <message>
            <source>The assistance</source>
            <translation type="unfinished">Die Unterstützung</translation>
        </message>
        <message>
            <source>What is shown</source>
            <translation type="unfinished">Was gezeigt wird</translation>
        </message>
        <message>
            <source>Window, slab and layout</source>
            <translation type="unfinished">Fensterung, Slab und Anordnung</translation>
        </message>
        <message>
            <source>What moves the hand</source>
            <translation type="unfinished">Womit die Hand bewegt wird</translation>
        </message>
        <message>
            <source>The way effects are computed</source>
            <translation type="unfinished">Wie Effekte berechnet werden</translation>
        </message>
        <message>
            <source>Locked for the student</source>
            <translation type="unfinished">Für Teilnehmer gesperrt</translation>
        </message>
        <message>
            <source>The student's own</source>
            <translation type="unfinished">Die des Teilnehmers</translation>
        </message>
        <message>
            <source>Mouse</source>
            <translation type="unfinished">Maus</translation>
        </message>
        <message>
            <source>Tablet</source>
            <translation type="unfinished">Grafiktablett</translation>
        </message>
        <message>
            <source>Gamepad</source>
            <translation type="unfinished">Gamepad</translation>
        </message>
        <message>
            <source>Hand</source>
            <translation type="unfinished">Hand</translation>
        </message>
        <message>
            <source>As the exercise's level has it</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Steady</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Unsteady as at level {n}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Simulated hand</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Window of the CT</source>
            <translation type="unfinished">Fensterung des CT</translation>
        </message>
        <message>
            <source>Along the needle</source>
            <translation type="unfinished">Entlang der Nadel</translation>
        </message>
        <message>
            <source>Layout of the panes</source>
            <translation type="unfinished">Anordnung der Ansichten</translation>
        </message>
        <message>
            <source>Mean</source>
            <translation type="unfinished">Mittel</translation>
        </message>
        <message>
            <source>Brightest</source>
            <translation type="unfinished">Hellstes</translation>
        </message>
        <message>
            <source>Darkest</source>
            <translation type="unfinished">Dunkelstes</translation>
        </message>
        <message>
            <source>Slab</source>
            <translation type="unfinished">Slab</translation>
        </message>
        <message>
            <source>Thickness of the slab</source>
            <translation type="unfinished">Dicke des Slabs</translation>
        </message>
        <message>
            <source>Take window and slab from the axial pane</source>
            <translation type="unfinished">Fensterung und Slab der axialen Ansicht übernehmen</translation>
        </message>
        <message>
            <source>Window, slab and layout stay as given here</source>
            <translation type="unfinished">Fensterung, Slab und Anordnung bleiben wie hier angegeben</translation>
        </message>
        <message>
            <source>Slices of a control scan</source>
            <translation type="unfinished">Schichten eines Kontrollscans</translation>
        </message>
        <message>
            <source>Thickness of a slice</source>
            <translation type="unfinished">Dicke einer Schicht</translation>
        </message>
        <message>
            <source>Dose of a slice, a teaching estimate</source>
            <translation type="unfinished">Dosis einer Schicht, ein Schätzwert für die Lehre</translation>
        </message>
        <message>
            <source>Metal leaves a streak in control scans</source>
            <translation type="unfinished">Metall hinterlässt einen Streifen in Kontrollscans</translation>
        </message>
        <message>
            <source>Not shown: the needle is seen on control scans alone</source>
            <translation type="unfinished">Nicht gezeigt: Die Nadel ist nur auf Kontrollscans zu sehen</translation>
        </message>
        <message>
            <source>Where control scans guide, the assistance is the exercise's own</source>
            <translation type="unfinished">Wo Kontrollscans führen, gilt die Unterstützung der Übung</translation>
        </message>
        <message>
            <source>An assessment locks all of them</source>
            <translation type="unfinished">Eine Prüfung sperrt sie alle</translation>
        </message>
        <message>
            <source>Layers of tissue, from the skin inwards</source>
            <translation type="unfinished">Gewebeschichten, von der Haut nach innen</translation>
        </message>
        <message>
            <source>Where they come from</source>
            <translation type="unfinished">Woher sie kommen</translation>
        </message>
        <message>
            <source>this table</source>
            <translation type="unfinished">diese Tabelle</translation>
        </message>
        <message>
            <source>the CT along the path, found when an attempt begins</source>
            <translation type="unfinished">das CT entlang des Pfads, beim Beginn eines Versuchs bestimmt</translation>
        </message>
        <message>
            <source>Add what is absent</source>
            <translation type="unfinished">Fehlendes ergänzen</translation>
        </message>
        <message>
            <source>measuring what it costs …</source>
            <translation type="unfinished">Kosten werden gemessen …</translation>
        </message>
        <message>
            <source>{name}: {ns:.0f} ns of each tick</source>
            <translation type="unfinished">{name}: {ns:.0f} ns je Takt</translation>
        </message>
        <message>
            <source>together {share:.2f} % of the millisecond that a tick has</source>
            <translation type="unfinished">zusammen {share:.2f} % der Millisekunde, die ein Takt hat</translation>
        </message>
        <message>
            <source>{name}: {ms:.2f} ms for each picture of a camera</source>
            <translation type="unfinished">{name}: {ms:.2f} ms je Kamerabild</translation>
        </message>
        <message>
            <source>It cannot be measured: {reason}</source>
            <translation type="unfinished">Es lässt sich nicht messen: {reason}</translation>
        </message>
        <message>
            <source>✖ {name} is called for: {reason} ({ns:.0f} ns of each tick)</source>
            <translation type="unfinished">✖ {name} wird gebraucht: {reason} ({ns:.0f} ns je Takt)</translation>
        </message>
        <message>
            <source>None is given: the body is of one tissue.</source>
            <translation type="unfinished">Keine angegeben: Der Körper besteht aus einem einzigen Gewebe.</translation>
        </message>
        <message>
            <source>Layer</source>
            <translation type="unfinished">Gewebeschicht</translation>
        </message>
        <message>
            <source>thick
[mm]</source>
            <translation type="unfinished">Dicke
[mm]</translation>
        </message>
        <message>
            <source>side stiffness
[kPa]</source>
            <translation type="unfinished">Seitensteifigkeit
[kPa]</translation>
        </message>
        <message>
            <source>friction
[N/m]</source>
            <translation type="unfinished">Reibung
[N/m]</translation>
        </message>
        <message>
            <source>break-away
[N/m]</source>
            <translation type="unfinished">Losbrechen
[N/m]</translation>
        </message>
        <message>
            <source>viscous
[N·s/m²]</source>
            <translation type="unfinished">viskos
[N·s/m²]</translation>
        </message>
        <message>
            <source>puncture,
18 G [N]</source>
            <translation type="unfinished">Durchstich,
18 G [N]</translation>
        </message>
        <message>
            <source>toughness
[J/m²]</source>
            <translation type="unfinished">Zähigkeit
[J/m²]</translation>
        </message>
        <message>
            <source>dimple
[N/m]</source>
            <translation type="unfinished">Eindellung
[N/m]</translation>
        </message>
        <message>
            <source>dimple
[N/m²]</source>
            <translation type="unfinished">Eindellung
[N/m²]</translation>
        </message>
        <message>
            <source>relaxing
share</source>
            <translation type="unfinished">Relaxation
Anteil</translation>
        </message>
        <message>
            <source>relaxing
[s]</source>
            <translation type="unfinished">Relaxation
[s]</translation>
        </message>
        <message>
            <source>bone</source>
            <translation type="unfinished">Knochen</translation>
        </message>
        <message>
            <source>Add a layer</source>
            <translation type="unfinished">Gewebeschicht hinzufügen</translation>
        </message>
        <message>
            <source>Remove</source>
            <translation type="unfinished">Entfernen</translation>
        </message>
        <message>
            <source>Outwards</source>
            <translation type="unfinished">Nach außen</translation>
        </message>
        <message>
            <source>Inwards</source>
            <translation type="unfinished">Nach innen</translation>
        </message>
        <message>
            <source>From the CT</source>
            <translation type="unfinished">Aus dem CT</translation>
        </message>
        <message>
            <source>Fills the table with what the needle meets on its path.</source>
            <translation type="unfinished">Füllt die Tabelle mit dem, worauf die Nadel auf ihrem Pfad trifft.</translation>
        </message>
        <message>
            <source>yes</source>
            <translation type="unfinished">ja</translation>
        </message>
        <message>
            <source>everything</source>
            <translation type="unfinished">alles</translation>
        </message>
        <message>
            <source>acts on</source>
            <translation type="unfinished">wirkt auf</translation>
        </message>
        <message>
            <source>computed by</source>
            <translation type="unfinished">berechnet mit</translation>
        </message>
        <message>
            <source>What scripted skills would score</source>
            <translation type="unfinished">Was Skripte verschiedenen Könnens erreichen würden</translation>
        </message>
        <message>
            <source>pass</source>
            <translation type="unfinished">bestanden</translation>
        </message>
        <message>
            <source>Score</source>
            <translation type="unfinished">Bewertung</translation>
        </message>
        <message>
            <source>Counts</source>
            <translation type="unfinished">Zählt</translation>
        </message>
        <message>
            <source>expert</source>
            <translation type="unfinished">Experte</translation>
        </message>
        <message>
            <source>good</source>
            <translation type="unfinished">gut</translation>
        </message>
        <message>
            <source>zero</source>
            <translation type="unfinished">null</translation>
        </message>
        <message>
            <source>weight</source>
            <translation type="unfinished">Gewicht</translation>
        </message>
        <message>
            <source>must</source>
            <translation type="unfinished">Pflicht</translation>
        </message>
        <message>
            <source>Bands: from “expert” on all points, beyond “zero” none</source>
            <translation type="unfinished">Einstufung: ab „Experte“ alle Punkte, jenseits von „null“ keine</translation>
        </message>
        <message>
            <source>Total needed to pass</source>
            <translation type="unfinished">Zum Bestehen nötige Gesamtpunktzahl</translation>
        </message>
        <message>
            <source>Void below this share of the insertion with a measured depth</source>
            <translation type="unfinished">Ungültig unter diesem Anteil der Punktion mit gemessener Tiefe</translation>
        </message>
        <message>
            <source>Void beyond this time of waiting for the cameras</source>
            <translation type="unfinished">Ungültig ab dieser Wartezeit auf die Kameras</translation>
        </message>
        <message>
            <source>The rings of “Off the path” are drawn on the CT as you change them.</source>
            <translation type="unfinished">Die Ringe zu „Seitlicher Fehler“ werden auf dem CT gezeichnet, während Sie sie ändern.</translation>
        </message>
        <message>
            <source>Check and keep</source>
            <translation type="unfinished">Prüfen und speichern</translation>
        </message>
        <message>
            <source>File of the exercise</source>
            <translation type="unfinished">Datei der Übung</translation>
        </message>
        <message>
            <source>▲ The exercise can be used, but: {why}</source>
            <translation type="unfinished">▲ Die Übung ist verwendbar, aber: {why}</translation>
        </message>
        <message>
            <source>✔ The exercise can be used.</source>
            <translation type="unfinished">✔ Die Übung ist verwendbar.</translation>
        </message>
        <message>
            <source>Calibration board {spec}</source>
            <translation type="unfinished">Kalibriertafel {spec}</translation>
        </message>
        <message>
            <source>Print at 100 %, not fitted to the page. The line above measures 100 mm: check it. Glue the sheet on something flat.</source>
            <translation type="unfinished">Mit 100 % drucken, nicht an die Seite anpassen. Die Linie oben misst 100 mm: Prüfen Sie das. Kleben Sie das Blatt auf etwas Ebenes.</translation>
        </message>
        <message>
            <source>Simulated</source>
            <translation type="unfinished">Simuliert</translation>
        </message>
        <message>
            <source>A camera that is plugged in, or typed: usb:PORT, folder:PATH, video:PATH</source>
            <translation type="unfinished">Eine angeschlossene Kamera oder eine Eingabe: usb:PORT, folder:PATH, video:PATH</translation>
        </message>
        <message>
            <source>Aim the cameras</source>
            <translation type="unfinished">Kameras ausrichten</translation>
        </message>
        <message>
            <source>Left</source>
            <translation type="unfinished">Links</translation>
        </message>
        <message>
            <source>Right</source>
            <translation type="unfinished">Rechts</translation>
        </message>
        <message>
            <source>Computing the cone</source>
            <translation type="unfinished">Kegel wird berechnet</translation>
        </message>
        <message>
            <source>{symbol} Standing as designed, both cameras would see {share:.0f} % of the cone</source>
            <translation type="unfinished">{symbol} Wie vorgesehen aufgestellt, sähen beide Kameras {share:.0f} % des Kegels</translation>
        </message>
        <message>
            <source>{symbol} Both cameras see {share:.0f} % of the needle's cone</source>
            <translation type="unfinished">{symbol} Beide Kameras sehen {share:.0f} % des Nadelkegels</translation>
        </message>
        <message>
            <source>{name}: would see {share:.0f} %</source>
            <translation type="unfinished">{name}: sähe {share:.0f} %</translation>
        </message>
        <message>
            <source>{name}: sees {share:.0f} %</source>
            <translation type="unfinished">{name}: sieht {share:.0f} %</translation>
        </message>
        <message>
            <source>Cone of: {basis}.</source>
            <translation type="unfinished">Grundlage des Kegels: {basis}.</translation>
        </message>
        <message>
            <source>The green line surrounds every place the marker can be at. It should lie within both pictures. The line follows from the calibration, not from the picture: after moving a camera, calibrate again.</source>
            <translation type="unfinished">Die grüne Linie umschließt alle Orte, an denen der Marker sein kann. Sie soll ganz in beiden Bildern liegen. Die Linie folgt aus der Kalibrierung, nicht aus dem Bild: Kalibrieren Sie neu, wenn eine Kamera bewegt wurde.</translation>
        </message>
        <message>
            <source>&amp;Cameras</source>
            <translation type="unfinished">&amp;Kameras</translation>
        </message>
        <message>
            <source>the cameras</source>
            <translation type="unfinished">die Kameras</translation>
        </message>
        <message>
            <source>Only simulated cameras are chosen, which need no aiming and have no latency: choose real ones in the menu Cameras, Set up.</source>
            <translation type="unfinished">Es sind nur simulierte Kameras gewählt; sie brauchen keine Ausrichtung und haben keine Latenz: Wählen Sie echte im Menü Kameras, Einrichten.</translation>
        </message>
        <message>
            <source>Simulated cameras</source>
            <translation type="unfinished">Simulierte Kameras</translation>
        </message>
        <message>
            <source>Set up…</source>
            <translation type="unfinished">Einrichten…</translation>
        </message>
        <message>
            <source>Aim…</source>
            <translation type="unfinished">Ausrichten…</translation>
        </message>
        <message>
            <source>Calibrate…</source>
            <translation type="unfinished">Kalibrieren…</translation>
        </message>
        <message>
            <source>Latency</source>
            <translation type="unfinished">Latenz</translation>
        </message>
        <message>
            <source>Measure how late a picture arrives: a patch blinks, the camera watches it, the delay is saved</source>
            <translation type="unfinished">Misst, wie spät ein Bild ankommt: Ein Feld blinkt, die Kamera sieht zu, die Verzögerung wird gespeichert</translation>
        </message>
        <message>
            <source>Which cameras there are: size, rate, exposure, live pictures</source>
            <translation type="unfinished">Welche Kameras es gibt: Größe, Bildrate, Belichtung, Livebilder</translation>
        </message>
        <message>
            <source>Where the needle can be, drawn into both live pictures</source>
            <translation type="unfinished">Wo die Nadel sein kann, in beide Livebilder eingezeichnet</translation>
        </message>
        <message>
            <source>Lenses and places of the cameras, from pictures of a board</source>
            <translation type="unfinished">Objektive und Standorte der Kameras, aus Bildern einer Tafel</translation>
        </message>
        <message>
            <source>Left camera…</source>
            <translation type="unfinished">Linke Kamera…</translation>
        </message>
        <message>
            <source>Right camera…</source>
            <translation type="unfinished">Rechte Kamera…</translation>
        </message>
        <message>
            <source>Real cameras: choose…</source>
            <translation type="unfinished">Echte Kameras: wählen…</translation>
        </message>
        <message>
            <source>Real cameras: {left}, {right}</source>
            <translation type="unfinished">Echte Kameras: {left}, {right}</translation>
        </message>
        <message>
            <source>left</source>
            <translation type="unfinished">links</translation>
        </message>
        <message>
            <source>right</source>
            <translation type="unfinished">rechts</translation>
        </message>
        <message>
            <source>Latency of the {name} camera</source>
            <translation type="unfinished">Latenz der Kamera {name}</translation>
        </message>
        <message>
            <source>Start</source>
            <translation type="unfinished">Start</translation>
        </message>
        <message>
            <source>measuring: leave camera and window where they are</source>
            <translation type="unfinished">Messung läuft: Lassen Sie Kamera und Fenster, wo sie sind</translation>
        </message>
        <message>
            <source>the camera was lost; start again</source>
            <translation type="unfinished">Verbindung zur Kamera verloren; starten Sie neu</translation>
        </message>
        <message>
            <source>From the screen to the delivered picture: {value}</source>
            <translation type="unfinished">Vom Bildschirm bis zum gelieferten Bild: {value}</translation>
        </message>
        <message>
            <source>Point the camera at the patch, a hand's breadth away, so that the patch fills a good part of the picture. The patch blinks at random for {seconds:.0f} s. The result contains the screen's own delay, usually one or two of its pictures (10 to 30 ms).</source>
            <translation type="unfinished">Richten Sie die Kamera aus einer Handbreit Abstand auf das Feld, sodass es einen guten Teil des Bildes füllt. Das Feld blinkt {seconds:.0f} s lang zufällig. Das Ergebnis enthält die Verzögerung des Bildschirms selbst, meist ein oder zwei seiner Bilder (10 bis 30 ms).</translation>
        </message>
        <message>
            <source>no picture</source>
            <translation type="unfinished">kein Bild</translation>
        </message>
        <message>
            <source>opening the camera …</source>
            <translation type="unfinished">Kamera wird geöffnet …</translation>
        </message>
        <message>
            <source>Opening the camera</source>
            <translation type="unfinished">Kamera wird geöffnet</translation>
        </message>
        <message>
            <source>opening the camera: {what}</source>
            <translation type="unfinished">Kamera wird geöffnet: {what}</translation>
        </message>
        <message>
            <source>{rate:.0f} pictures/s, jitter {jitter:.1f} ms</source>
            <translation type="unfinished">{rate:.0f} Bilder/s, Jitter {jitter:.1f} ms</translation>
        </message>
        <message>
            <source> ms</source>
            <translation type="unfinished"> ms</translation>
        </message>
        <message>
            <source>as the camera finds it, then held</source>
            <translation type="unfinished">wie die Kamera sie findet, dann gehalten</translation>
        </message>
        <message>
            <source>Source</source>
            <translation type="unfinished">Quelle</translation>
        </message>
        <message>
            <source>Exposure</source>
            <translation type="unfinished">Belichtung</translation>
        </message>
        <message>
            <source>Left camera</source>
            <translation type="unfinished">Linke Kamera</translation>
        </message>
        <message>
            <source>Right camera</source>
            <translation type="unfinished">Rechte Kamera</translation>
        </message>
        <message>
            <source>Exchange left and right</source>
            <translation type="unfinished">Links und rechts tauschen</translation>
        </message>
        <message>
            <source>simulated: nothing to set up</source>
            <translation type="unfinished">simuliert: nichts einzurichten</translation>
        </message>
        <message>
            <source> per second</source>
            <translation type="unfinished"> pro Sekunde</translation>
        </message>
        <message>
            <source>Left and right are as seen from the side on which the cameras stand. Hold a hand before one camera: its picture must be the one below its name.</source>
            <translation type="unfinished">Links und rechts gelten von der Seite aus, auf der die Kameras stehen. Halten Sie eine Hand vor eine Kamera: Ihr Bild muss das unter ihrem Namen sein.</translation>
        </message>
        <message>
            <source>No camera is plugged in. Plug both in, then open this dialog again; a folder or a video can be typed as source: folder:PATH, video:PATH.</source>
            <translation type="unfinished">Keine Kamera ist angeschlossen. Schließen Sie beide an und öffnen Sie dieses Fenster dann neu; als Quelle können Sie auch einen Ordner oder ein Video eingeben: folder:PATH, video:PATH.</translation>
        </message>
        <message>
            <source>Size</source>
            <translation type="unfinished">Größe</translation>
        </message>
        <message>
            <source>Pictures</source>
            <translation type="unfinished">Bilder</translation>
        </message>
        <message>
            <source>Save as PDF to print…</source>
            <translation type="unfinished">Als PDF zum Drucken speichern…</translation>
        </message>
        <message>
            <source>Board</source>
            <translation type="unfinished">Tafel</translation>
        </message>
        <message>
            <source>written to {file}: print it at 100 % and measure the line of 100 mm</source>
            <translation type="unfinished">in {file} geschrieben: Drucken Sie mit 100 % und messen Sie die Linie von 100 mm nach</translation>
        </message>
        <message>
            <source>Squares</source>
            <translation type="unfinished">Quadrate</translation>
        </message>
        <message>
            <source>Inner corners</source>
            <translation type="unfinished">Innere Ecken</translation>
        </message>
        <message>
            <source>{why}. A board that you have already can be used all the same.</source>
            <translation type="unfinished">{why}. Eine Tafel, die Sie schon haben, können Sie trotzdem verwenden.</translation>
        </message>
        <message>
            <source>This board looks the same after half a turn. The program mends what it can; a ChArUco board needs no mending.</source>
            <translation type="unfinished">Diese Tafel sieht nach einer halben Drehung gleich aus. Das Programm gleicht aus, was es kann; bei einer ChArUco-Tafel ist das nicht nötig.</translation>
        </message>
        <message>
            <source>{w:.0f} × {h:.0f} mm</source>
            <translation type="unfinished">{w:.0f} × {h:.0f} mm</translation>
        </message>
        <message>
            <source>Save the board</source>
            <translation type="unfinished">Tafel speichern</translation>
        </message>
        <message>
            <source>PDF (*.pdf)</source>
            <translation type="unfinished">PDF (*.pdf)</translation>
        </message>
        <message>
            <source>ChArUco (recommended)</source>
            <translation type="unfinished">ChArUco (empfohlen)</translation>
        </message>
        <message>
            <source>Checkerboard</source>
            <translation type="unfinished">Schachbrett</translation>
        </message>
        <message>
            <source>Which board do you have?</source>
            <translation type="unfinished">Welche Tafel haben Sie?</translation>
        </message>
        <message>
            <source>A flat board with squares of a known size. ChArUco may be seen in part and always says which way round it lies.</source>
            <translation type="unfinished">Eine ebene Tafel mit Quadraten bekannter Größe. ChArUco darf teilweise verdeckt sein und zeigt immer, wie herum sie liegt.</translation>
        </message>
        <message>
            <source>Measure the line of 100 mm below the board, and type the squares as they are: a print at 97 % leaves every residual as good as it was, and makes all that is measured 3 % too long.</source>
            <translation type="unfinished">Messen Sie die Linie von 100 mm unter der Tafel und geben Sie die Quadrate so ein, wie sie sind: Ein Druck mit 97 % lässt jeden Restfehler so gut, wie er war, und macht alles Gemessene 3 % zu lang.</translation>
        </message>
        <message>
            <source>Kind</source>
            <translation type="unfinished">Art</translation>
        </message>
        <message>
            <source>Side of a square</source>
            <translation type="unfinished">Seite eines Quadrats</translation>
        </message>
        <message>
            <source>Side of a marker</source>
            <translation type="unfinished">Seite eines Markers</translation>
        </message>
        <message>
            <source>Markers</source>
            <translation type="unfinished">Marker</translation>
        </message>
        <message>
            <source>Paper</source>
            <translation type="unfinished">Papier</translation>
        </message>
        <message>
            <source>Calibration of the cameras</source>
            <translation type="unfinished">Kalibrierung der Kameras</translation>
        </message>
        <message>
            <source>Choose a board that can be</source>
            <translation type="unfinished">Wählen Sie eine mögliche Tafel</translation>
        </message>
        <message>
            <source>Take or open pictures first. To place or to import a calibration without any, choose the page in the list.</source>
            <translation type="unfinished">Nehmen Sie zuerst Bilder auf oder öffnen Sie welche. Um ohne Bilder die Lage zu bestimmen oder eine Kalibrierung zu importieren, wählen Sie die Seite in der Liste.</translation>
        </message>
        <message>
            <source>There is no result yet</source>
            <translation type="unfinished">Es gibt noch kein Ergebnis</translation>
        </message>
        <message>
            <source>Unsaved calibration</source>
            <translation type="unfinished">Kalibrierung nicht gespeichert</translation>
        </message>
        <message>
            <source>Pictures and calibration are not saved and will be lost. Close all the same?</source>
            <translation type="unfinished">Bilder und Kalibrierung sind nicht gespeichert und gehen verloren. Trotzdem schließen?</translation>
        </message>
        <message>
            <source>{camera}: {n} different views, {share} % covered</source>
            <translation type="unfinished">{camera}: verschiedene Aufnahmen: {n}, {share} % abgedeckt</translation>
        </message>
        <message>
            <source>no picture yet</source>
            <translation type="unfinished">noch kein Bild</translation>
        </message>
        <message>
            <source>Begin with the live cameras</source>
            <translation type="unfinished">Mit den Livekameras beginnen</translation>
        </message>
        <message>
            <source>Pictures of a folder…</source>
            <translation type="unfinished">Bilder aus einem Ordner…</translation>
        </message>
        <message>
            <source>Stop</source>
            <translation type="unfinished">Stopp</translation>
        </message>
        <message>
            <source>Drop the last</source>
            <translation type="unfinished">Letztes verwerfen</translation>
        </message>
        <message>
            <source>opening the cameras …</source>
            <translation type="unfinished">Kameras werden geöffnet …</translation>
        </message>
        <message>
            <source>Choose real cameras in the menu Cameras first</source>
            <translation type="unfinished">Wählen Sie zuerst echte Kameras im Menü Kameras</translation>
        </message>
        <message>
            <source>No pictures yet.</source>
            <translation type="unfinished">Noch keine Bilder.</translation>
        </message>
        <message>
            <source>looking for the board …</source>
            <translation type="unfinished">Tafel wird gesucht …</translation>
        </message>
        <message>
            <source>✔ There are enough views: go on, or take more.</source>
            <translation type="unfinished">✔ Es sind genug Aufnahmen: Gehen Sie weiter oder machen Sie mehr.</translation>
        </message>
        <message>
            <source>Folder of the pictures</source>
            <translation type="unfinished">Ordner der Bilder</translation>
        </message>
        <message>
            <source>Show the board to both cameras</source>
            <translation type="unfinished">Zeigen Sie beiden Kameras die Tafel</translation>
        </message>
        <message>
            <source>Hold it still for a moment, then move it on: near and far, to every corner of the pictures, tilted to all sides. A useful picture is taken by itself. From a folder, pictures are paired by name: left01.png with right01.png.</source>
            <translation type="unfinished">Halten Sie sie einen Moment still und bewegen Sie sie dann weiter: nah und fern, in jede Ecke der Bilder, nach allen Seiten geneigt. Ein brauchbares Bild wird von selbst aufgenommen. Aus einem Ordner werden Bilder nach Namen gepaart: left01.png mit right01.png.</translation>
        </message>
        <message>
            <source>Take it with the cameras</source>
            <translation type="unfinished">Mit den Kameras aufnehmen</translation>
        </message>
        <message>
            <source>Drop all places</source>
            <translation type="unfinished">Alle Lagen verwerfen</translation>
        </message>
        <message>
            <source>Place</source>
            <translation type="unfinished">Lage</translation>
        </message>
        <message>
            <source>for calibration {id}</source>
            <translation type="unfinished">für Kalibrierung {id}</translation>
        </message>
        <message>
            <source>world frame found from one place; another place makes it better</source>
            <translation type="unfinished">Weltkoordinaten aus einer Lage bestimmt; eine weitere macht sie besser</translation>
        </message>
        <message>
            <source>world frame found from {n} places</source>
            <translation type="unfinished">Weltkoordinaten aus {n} Lagen bestimmt</translation>
        </message>
        <message>
            <source>cancelled</source>
            <translation type="unfinished">abgebrochen</translation>
        </message>
        <message>
            <source>Pictures of the board at this place</source>
            <translation type="unfinished">Bilder der Tafel in dieser Lage</translation>
        </message>
        <message>
            <source>Lay the board at a known place</source>
            <translation type="unfinished">Legen Sie die Tafel an einen bekannten Ort</translation>
        </message>
        <message>
            <source>The place is that of the first inner corner, in the robot's frame: origin midway between the motor axes, x to the right motor, z up. Turned by 180° about x the board lies print up with its columns along x. Several places are better than one.</source>
            <translation type="unfinished">Die Lage ist die der ersten inneren Ecke in den Koordinaten des Roboters: Ursprung mitten zwischen den Motorachsen, x zum rechten Motor, z nach oben. Um 180° um x gedreht liegt die Tafel mit dem Druck nach oben, ihre Spalten entlang x. Mehrere Lagen sind besser als eine.</translation>
        </message>
        <message>
            <source>about x</source>
            <translation type="unfinished">um x</translation>
        </message>
        <message>
            <source>about y</source>
            <translation type="unfinished">um y</translation>
        </message>
        <message>
            <source>about z</source>
            <translation type="unfinished">um z</translation>
        </message>
        <message>
            <source>Compute again</source>
            <translation type="unfinished">Neu berechnen</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation type="unfinished">Abbrechen</translation>
        </message>
        <message>
            <source>Pair</source>
            <translation type="unfinished">Paar</translation>
        </message>
        <message>
            <source>px</source>
            <translation type="unfinished">px</translation>
        </message>
        <message>
            <source>Remark</source>
            <translation type="unfinished">Bemerkung</translation>
        </message>
        <message>
            <source>Parameter</source>
            <translation type="unfinished">Parameter</translation>
        </message>
        <message>
            <source>Result</source>
            <translation type="unfinished">Ergebnis</translation>
        </message>
        <message>
            <source>computing …</source>
            <translation type="unfinished">wird berechnet …</translation>
        </message>
        <message>
            <source>There are no pictures yet.</source>
            <translation type="unfinished">Es gibt noch keine Bilder.</translation>
        </message>
        <message>
            <source>Not to be used: a measured length contradicts it.</source>
            <translation type="unfinished">Nicht verwendbar: Eine gemessene Länge widerspricht ihr.</translation>
        </message>
        <message>
            <source>computing: {what}</source>
            <translation type="unfinished">wird berechnet: {what}</translation>
        </message>
        <message>
            <source>Cancelled; nothing was kept.</source>
            <translation type="unfinished">Abgebrochen; nichts wurde gespeichert.</translation>
        </message>
        <message>
            <source> mm</source>
            <translation type="unfinished"> mm</translation>
        </message>
        <message>
            <source>not measured</source>
            <translation type="unfinished">nicht gemessen</translation>
        </message>
        <message>
            <source>Distance of the lenses by ruler</source>
            <translation type="unfinished">Abstand der Objektive mit dem Lineal</translation>
        </message>
        <message>
            <source>Import a calibration</source>
            <translation type="unfinished">Kalibrierung importieren</translation>
        </message>
        <message>
            <source>Files…</source>
            <translation type="unfinished">Dateien…</translation>
        </message>
        <message>
            <source>Folder…</source>
            <translation type="unfinished">Ordner…</translation>
        </message>
        <message>
            <source>Import and use it</source>
            <translation type="unfinished">Importieren und verwenden</translation>
        </message>
        <message>
            <source>nothing is chosen yet</source>
            <translation type="unfinished">noch nichts gewählt</translation>
        </message>
        <message>
            <source>reading …</source>
            <translation type="unfinished">wird gelesen …</translation>
        </message>
        <message>
            <source>Calibration files, left before right</source>
            <translation type="unfinished">Kalibrierdateien, links vor rechts</translation>
        </message>
        <message>
            <source>Calibrations (*.yaml *.yml *.xml);;All files (*)</source>
            <translation type="unfinished">Kalibrierungen (*.yaml *.yml *.xml);;Alle Dateien (*)</translation>
        </message>
        <message>
            <source>Folder of TemugeB's text files</source>
            <translation type="unfinished">Ordner der Textdateien von TemugeB</translation>
        </message>
        <message>
            <source>Unit of the board's square (--unit)</source>
            <translation type="unfinished">Einheit des Tafelquadrats (--unit)</translation>
        </message>
        <message>
            <source>Size of the pictures (--size)</source>
            <translation type="unfinished">Größe der Bilder (--size)</translation>
        </message>
        <message>
            <source>One YAML of Acus; left and right YAML of ICube or ROS; the folder of TemugeB's text files; or intrinsics.yml and extrinsics.yml of OpenCV's stereo_calib. Only TemugeB's and OpenCV's files need unit and size. What other programs write does not say how sure it is, and has no place: find it on the page before.</source>
            <translation type="unfinished">Ein YAML von Acus; linkes und rechtes YAML von ICube oder ROS; der Ordner mit den Textdateien von TemugeB; oder intrinsics.yml und extrinsics.yml von stereo_calib (OpenCV). Nur die Dateien von TemugeB und OpenCV brauchen Einheit und Größe. Was andere Programme schreiben, sagt nicht, wie sicher es ist, und hat keine Lage: Bestimmen Sie sie auf der Seite davor.</translation>
        </message>
        <message>
            <source>✔ in use</source>
            <translation type="unfinished">✔ verwendet</translation>
        </message>
        <message>
            <source>✖ unreadable: {why}</source>
            <translation type="unfinished">✖ nicht lesbar: {why}</translation>
        </message>
        <message>
            <source>✖ found bad: {why}</source>
            <translation type="unfinished">✖ als schlecht gemeldet: {why}</translation>
        </message>
        <message>
            <source>{px:.2f} px</source>
            <translation type="unfinished">{px:.2f} px</translation>
        </message>
        <message>
            <source>, {mm:.3f} mm held back</source>
            <translation type="unfinished">, {mm:.3f} mm bei Kontrollpaaren</translation>
        </message>
        <message>
            <source>, own uncertainty not known</source>
            <translation type="unfinished">, eigene Unsicherheit unbekannt</translation>
        </message>
        <message>
            <source>placed</source>
            <translation type="unfinished">Lage bekannt</translation>
        </message>
        <message>
            <source>no place</source>
            <translation type="unfinished">keine Lage</translation>
        </message>
        <message>
            <source>Save and use it</source>
            <translation type="unfinished">Speichern und verwenden</translation>
        </message>
        <message>
            <source>Import…</source>
            <translation type="unfinished">Importieren…</translation>
        </message>
        <message>
            <source>Use this one</source>
            <translation type="unfinished">Diese verwenden</translation>
        </message>
        <message>
            <source>Found bad…</source>
            <translation type="unfinished">Als schlecht melden…</translation>
        </message>
        <message>
            <source>Calibration</source>
            <translation type="unfinished">Kalibrierung</translation>
        </message>
        <message>
            <source>State</source>
            <translation type="unfinished">Zustand</translation>
        </message>
        <message>
            <source>Save</source>
            <translation type="unfinished">Speichern</translation>
        </message>
        <message>
            <source>saved as {id} and in use</source>
            <translation type="unfinished">als {id} gespeichert und in Verwendung</translation>
        </message>
        <message>
            <source>There is nothing new to save.</source>
            <translation type="unfinished">Es gibt nichts Neues zu speichern.</translation>
        </message>
        <message>
            <source>Not saved yet. Without a place (the page before) it cannot be used to track.</source>
            <translation type="unfinished">Noch nicht gespeichert. Ohne Lage (die Seite davor) taugt sie nicht zum Tracking.</translation>
        </message>
        <message>
            <source>Not saved yet.</source>
            <translation type="unfinished">Noch nicht gespeichert.</translation>
        </message>
        <message>
            <source>; it has no place yet: find it on the page before</source>
            <translation type="unfinished">; sie hat noch keine Lage: Bestimmen Sie sie auf der Seite davor</translation>
        </message>
        <message>
            <source>imported as {id} and in use{note}</source>
            <translation type="unfinished">als {id} importiert und in Verwendung{note}</translation>
        </message>
        <message>
            <source>Found bad</source>
            <translation type="unfinished">Als schlecht melden</translation>
        </message>
        <message>
            <source>What is wrong with it? Attempts made with it will say so.</source>
            <translation type="unfinished">Was stimmt damit nicht? Versuche, die damit gemacht wurden, werden es zeigen.</translation>
        </message>
        <message>
            <source>Calibrations so far; none is ever deleted. One that proves bad is no longer used, and attempts made with it are flagged.</source>
            <translation type="unfinished">Bisherige Kalibrierungen; gelöscht wird keine. Eine, die sich als schlecht erweist, wird nicht mehr verwendet, und Versuche mit ihr werden markiert.</translation>
        </message>
        <message>
            <source>{pairs} pairs taken: both cameras see the board in each</source>
            <translation type="unfinished">Aufgenommene Paare: {pairs}; in jedem sehen beide Kameras die Tafel</translation>
        </message>
        <message>
            <source>no pair in which both cameras see the board</source>
            <translation type="unfinished">kein Paar, in dem beide Kameras die Tafel sehen</translation>
        </message>
        <message>
            <source>{pairs} pairs, all of which are used; {different} of them show the board unlike the others: only those count below</source>
            <translation type="unfinished">Paare: {pairs}, alle verwendet; {different} davon zeigen die Tafel anders als die übrigen: nur diese zählen unten</translation>
        </message>
        <message>
            <source>not used: {names}</source>
            <translation type="unfinished">nicht verwendet: {names}</translation>
        </message>
        <message>
            <source>Not good enough to use: glue the board on something flat, take sharper pictures, and check the board's counts and sizes.</source>
            <translation type="unfinished">Nicht gut genug: Kleben Sie die Tafel auf etwas Ebenes, nehmen Sie schärfere Bilder auf und prüfen Sie Anzahlen und Maße der Tafel.</translation>
        </message>
        <message>
            <source>It fits, but was not checked: there were too few pairs to hold some back. Take at least eight.</source>
            <translation type="unfinished">Es passt, wurde aber nicht geprüft: Es waren zu wenige Paare, um einige zurückzuhalten. Nehmen Sie mindestens acht auf.</translation>
        </message>
        <message>
            <source>Usable, but the pairs do not belong together: the board or a camera moved between the two pictures. What is stated is wider for it; hold the board still and take them again.</source>
            <translation type="unfinished">Verwendbar, aber die Paare gehören nicht zusammen: Zwischen den beiden Bildern hat sich die Tafel oder eine Kamera bewegt. Die Angaben sind deshalb weiter gefasst; halten Sie die Tafel still und nehmen Sie die Paare neu auf.</translation>
        </message>
        <message>
            <source>Usable, but the board moved while its pictures were read row by row (rolling shutter): distances come out wrong. Hold the board against something still and take them again.</source>
            <translation type="unfinished">Verwendbar, aber die Tafel bewegte sich, während ihre Bilder Zeile für Zeile gelesen wurden (Rolling Shutter): Abstände werden falsch. Halten Sie die Tafel gegen etwas Festes und nehmen Sie die Bilder neu auf.</translation>
        </message>
        <message>
            <source>Usable, but only where the board was seen: elsewhere in the pictures the rays are hardly known. Take more pairs with the board near the edges and corners.</source>
            <translation type="unfinished">Verwendbar, aber nur dort, wo die Tafel zu sehen war: Anderswo in den Bildern sind die Strahlen kaum bekannt. Nehmen Sie mehr Paare mit der Tafel nahe an Rändern und Ecken auf.</translation>
        </message>
        <message>
            <source>Usable, but worse than usual: more and sharper views will do better.</source>
            <translation type="unfinished">Verwendbar, aber schlechter als üblich: Mehr und schärfere Aufnahmen helfen.</translation>
        </message>
        <message>
            <source>Good: pairs that took no part come out right.</source>
            <translation type="unfinished">Gut: Auch Paare, die nicht beteiligt waren, stimmen.</translation>
        </message>
        <message>
            <source>The board's size is not checked: nothing else here can tell.</source>
            <translation type="unfinished">Die Größe der Tafel ist nicht geprüft: Nichts anderes hier kann sie zeigen.</translation>
        </message>
        <message>
            <source>Residual</source>
            <translation type="unfinished">Restfehler</translation>
        </message>
        <message>
            <source>{pair:.2f} px both, {left:.2f} px {l}, {right:.2f} px {r}</source>
            <translation type="unfinished">{pair:.2f} px beide, {left:.2f} px {l}, {right:.2f} px {r}</translation>
        </message>
        <message>
            <source>Distance of the cameras</source>
            <translation type="unfinished">Abstand der Kameras</translation>
        </message>
        <message>
            <source>{mm:.2f} ± {sd:.2f} mm</source>
            <translation type="unfinished">{mm:.2f} ± {sd:.2f} mm</translation>
        </message>
        <message>
            <source>{n} pairs, {points} corners: {rms:.3f} mm RMS, {most:.3f} mm at most</source>
            <translation type="unfinished">Paare: {n}, Ecken: {points}; {rms:.3f} mm RMS, höchstens {most:.3f} mm</translation>
        </message>
        <message>
            <source>Pairs held back</source>
            <translation type="unfinished">Kontrollpaare</translation>
        </message>
        <message>
            <source>Lengths in them</source>
            <translation type="unfinished">Längen darin</translation>
        </message>
        <message>
            <source>{scale:.5f} ± {sd:.5f} times the true ones</source>
            <translation type="unfinished">{scale:.5f} ± {sd:.5f} mal die wahren</translation>
        </message>
        <message>
            <source>(dropped)</source>
            <translation type="unfinished">(weggelassen)</translation>
        </message>
        <message>
            <source>In brackets: the views do not tell it; 0 is used.</source>
            <translation type="unfinished">In Klammern: Die Aufnahmen zeigen es nicht; 0 wird verwendet.</translation>
        </message>
        <message>
            <source>outlier, left out</source>
            <translation type="unfinished">Ausreißer, weggelassen</translation>
        </message>
        <message>
            <source>held back</source>
            <translation type="unfinished">Kontrollpaar</translation>
        </message>
        <message>
            <source>{camera} camera at x {x:.0f}, y {y:.0f}, z {z:.0f} mm</source>
            <translation type="unfinished">Kamera {camera} bei x {x:.0f}, y {y:.0f}, z {z:.0f} mm</translation>
        </message>
        <message>
            <source>corners within {px:.2f} px</source>
            <translation type="unfinished">Ecken auf {px:.2f} px genau</translation>
        </message>
        <message>
            <source>at the fulcrum the frame is sure to ± {mm:.2f} mm (standard deviation per axis)</source>
            <translation type="unfinished">am Drehpunkt sind die Koordinaten auf ± {mm:.2f} mm sicher (Standardabweichung je Achse)</translation>
        </message>
        <message>
            <source>places agree within {mm:.1f} mm</source>
            <translation type="unfinished">Lagen stimmen auf {mm:.1f} mm überein</translation>
        </message>
        <message>
            <source>Daily check</source>
            <translation type="unfinished">Tageskontrolle</translation>
        </message>
        <message>
            <source>Touch now</source>
            <translation type="unfinished">Jetzt berühren</translation>
        </message>
        <message>
            <source>Bring the simulated tip there</source>
            <translation type="unfinished">Simulierte Spitze hinbringen</translation>
        </message>
        <message>
            <source>Keep as today's check</source>
            <translation type="unfinished">Als heutige Kontrolle speichern</translation>
        </message>
        <message>
            <source>nothing runs yet</source>
            <translation type="unfinished">noch läuft nichts</translation>
        </message>
        <message>
            <source>choose an exercise and a patient: robot and cameras start with them</source>
            <translation type="unfinished">Wählen Sie eine Übung und einen Patienten: Roboter und Kameras starten dann mit</translation>
        </message>
        <message>
            <source>Everything is well</source>
            <translation type="unfinished">Alles in Ordnung</translation>
        </message>
        <message>
            <source>Usable, with remarks</source>
            <translation type="unfinished">Verwendbar, mit Bemerkungen</translation>
        </message>
        <message>
            <source>Not ready</source>
            <translation type="unfinished">Nicht bereit</translation>
        </message>
        <message>
            <source>Something is still to be done</source>
            <translation type="unfinished">Es ist noch etwas zu tun</translation>
        </message>
        <message>
            <source>never checked</source>
            <translation type="unfinished">nie kontrolliert</translation>
        </message>
        <message>
            <source>Known point</source>
            <translation type="unfinished">Bekannter Punkt</translation>
        </message>
        <message>
            <source>Screen and needle</source>
            <translation type="unfinished">Bildschirm und Nadel</translation>
        </message>
        <message>
            <source>check failed</source>
            <translation type="unfinished">Kontrolle nicht bestanden</translation>
        </message>
        <message>
            <source>not checked</source>
            <translation type="unfinished">nicht kontrolliert</translation>
        </message>
        <message>
            <source>Nobody has checked how well the needle on the screen agrees with the real one. Menu Checks, Registration check: touch the fiducials of a plate.</source>
            <translation type="unfinished">Niemand hat kontrolliert, wie gut die Nadel auf dem Bildschirm mit der echten übereinstimmt. Menü Kontrollen, Registrierungskontrolle: Berühren Sie die Referenzmarken einer Platte.</translation>
        </message>
        <message>
            <source>agree within ± {mm:.1f} mm (95 %)</source>
            <translation type="unfinished">stimmen auf ± {mm:.1f} mm überein (95 %)</translation>
        </message>
        <message>
            <source>How far the needle on the screen may be from the real one at the target: what the registration check found, with the cameras' error. {checked}</source>
            <translation type="unfinished">Wie weit die Nadel auf dem Bildschirm am Ziel von der echten abweichen kann: was die Registrierungskontrolle ergab, mit dem Fehler der Kameras. {checked}</translation>
        </message>
        <message>
            <source>{size}; the calibration's own uncertainty is unknown</source>
            <translation type="unfinished">{size}; die Unsicherheit der Kalibrierung selbst ist unbekannt</translation>
        </message>
        <message>
            <source>The calibration was imported and does not say how sure it is: the radius leaves its error out. Calibrate with pictures of a board to know it.</source>
            <translation type="unfinished">Die Kalibrierung wurde importiert und sagt nicht, wie sicher sie ist: Ihr Fehler fehlt im Radius. Kalibrieren Sie mit Bildern einer Tafel, um ihn zu kennen.</translation>
        </message>
        <message>
            <source>Daily check…</source>
            <translation type="unfinished">Tageskontrolle…</translation>
        </message>
        <message>
            <source>Registration check…</source>
            <translation type="unfinished">Registrierungskontrolle…</translation>
        </message>
        <message>
            <source>Draw errors of target and tip</source>
            <translation type="unfinished">Fehler von Ziel und Spitze zeichnen</translation>
        </message>
        <message>
            <source>Checked {when} with {plate}.</source>
            <translation type="unfinished">Kontrolliert am {when} mit {plate}.</translation>
        </message>
        <message>
            <source>A plan is needed first: place entry and target.</source>
            <translation type="unfinished">Zuerst ist ein Plan nötig: Setzen Sie Einstichpunkt und Ziel.</translation>
        </message>
        <message>
            <source>By the measured place the needle enters {moved:.0f} mm from the planned entry: lay the phantom so that its entry is at the robot's fulcrum (at most {most:.0f} mm), then measure again</source>
            <translation type="unfinished">Nach der gemessenen Lage sticht die Nadel {moved:.0f} mm neben dem geplanten Einstichpunkt ein: Legen Sie das Phantom so, dass sein Einstichpunkt am Drehpunkt des Roboters liegt (höchstens {most:.0f} mm daneben), und messen Sie dann neu</translation>
        </message>
        <message>
            <source>The measured place is used; the entry moved by {mm:.1f} mm</source>
            <translation type="unfinished">Die gemessene Lage wird verwendet; der Einstichpunkt hat sich um {mm:.1f} mm verschoben</translation>
        </message>
        <message>
            <source>Fiducial</source>
            <translation type="unfinished">Referenzmarke</translation>
        </message>
        <message>
            <source>Tip: x  y  z [mm]</source>
            <translation type="unfinished">Spitze: x  y  z [mm]</translation>
        </message>
        <message>
            <source>± 95 % [mm]</source>
            <translation type="unfinished">± 95 % [mm]</translation>
        </message>
        <message>
            <source>CT: L  P  S [mm]</source>
            <translation type="unfinished">CT: L  P  S [mm]</translation>
        </message>
        <message>
            <source>Residual [mm]</source>
            <translation type="unfinished">Restfehler [mm]</translation>
        </message>
        <message>
            <source>Pick the bead at the crosshair</source>
            <translation type="unfinished">Kugel am Fadenkreuz wählen</translation>
        </message>
        <message>
            <source>Forget</source>
            <translation type="unfinished">Vergessen</translation>
        </message>
        <message>
            <source>Use the measured place</source>
            <translation type="unfinished">Gemessene Lage verwenden</translation>
        </message>
        <message>
            <source>Registration check</source>
            <translation type="unfinished">Registrierungskontrolle</translation>
        </message>
        <message>
            <source>No CT is shown: open the CT of the scanned phantom.</source>
            <translation type="unfinished">Kein CT wird angezeigt: Öffnen Sie das CT des gescannten Phantoms.</translation>
        </message>
        <message>
            <source>The check could not be written: {why}</source>
            <translation type="unfinished">Die Kontrolle konnte nicht geschrieben werden: {why}</translation>
        </message>
        <message>
            <source>Plate</source>
            <translation type="unfinished">Platte</translation>
        </message>
        <message>
            <source>No cameras run: choose an exercise and a patient first.</source>
            <translation type="unfinished">Keine Kameras laufen: Wählen Sie zuerst eine Übung und einen Patienten.</translation>
        </message>
        <message>
            <source>Depth [mm]</source>
            <translation type="unfinished">Tiefe [mm]</translation>
        </message>
        <message>
            <source>target {mm:.0f} mm</source>
            <translation type="unfinished">Ziel {mm:.0f} mm</translation>
        </message>
        <message>
            <source>depth</source>
            <translation type="unfinished">Tiefe</translation>
        </message>
        <message>
            <source>Off the path [mm]</source>
            <translation type="unfinished">Seitlicher Fehler [mm]</translation>
        </message>
        <message>
            <source>off the path</source>
            <translation type="unfinished">seitlicher Fehler</translation>
        </message>
        <message>
            <source>Angle error [°]</source>
            <translation type="unfinished">Winkelfehler [°]</translation>
        </message>
        <message>
            <source>angle</source>
            <translation type="unfinished">Winkel</translation>
        </message>
        <message>
            <source>Force felt, {origin} [N]</source>
            <translation type="unfinished">Gefühlte Kraft, {origin} [N]</translation>
        </message>
        <message>
            <source>limit {n:g} N</source>
            <translation type="unfinished">Grenze {n:g} N</translation>
        </message>
        <message>
            <source>{origin} force</source>
            <translation type="unfinished">Kraft, {origin}</translation>
        </message>
        <message>
            <source>Time [s]</source>
            <translation type="unfinished">Zeit [s]</translation>
        </message>
        <message>
            <source>Point to read, click to go there; the wheel zooms, a double click shows all.</source>
            <translation type="unfinished">Zeigen zum Ablesen, klicken zum Springen; das Mausrad zoomt, ein Doppelklick zeigt alles.</translation>
        </message>
        <message>
            <source>ideal</source>
            <translation type="unfinished">ideal</translation>
        </message>
        <message>
            <source>Reading the other attempt</source>
            <translation type="unfinished">Anderer Versuch wird gelesen</translation>
        </message>
        <message>
            <source>Save report</source>
            <translation type="unfinished">Bericht speichern</translation>
        </message>
        <message>
            <source>not verified: the record is {verdict}</source>
            <translation type="unfinished">nicht bestätigt: Die Aufzeichnung ist {verdict}</translation>
        </message>
        <message>
            <source>Export attempt</source>
            <translation type="unfinished">Versuch exportieren</translation>
        </message>
        <message>
            <source>CSV (*.csv)</source>
            <translation type="unfinished">CSV (*.csv)</translation>
        </message>
        <message>
            <source>Export sessions</source>
            <translation type="unfinished">Sitzungen exportieren</translation>
        </message>
        <message>
            <source>Reading the attempt</source>
            <translation type="unfinished">Versuch wird gelesen</translation>
        </message>
        <message>
            <source>This attempt is another one's: sign in as who made it, or as the instructor.</source>
            <translation type="unfinished">Dieser Versuch gehört jemand anderem: Melden Sie sich als die Person an, die ihn gemacht hat, oder als Kursleiter.</translation>
        </message>
        <message>
            <source>This attempt is an assessment (course: {course}). The instructor releases its result; until then neither score nor replay is shown here.</source>
            <translation type="unfinished">Dieser Versuch ist eine Prüfung (Kurs: {course}). Der Kursleiter gibt das Ergebnis frei; bis dahin sind hier weder Bewertung noch Wiedergabe zu sehen.</translation>
        </message>
        <message>
            <source>Cannot write {file}: {why}</source>
            <translation type="unfinished">{file} lässt sich nicht schreiben: {why}</translation>
        </message>
        <message>
            <source>the expert, along your plan</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>the ideal path</source>
            <translation type="unfinished">der ideale Pfad</translation>
        </message>
        <message>
            <source>{who}: {total} ({date})</source>
            <translation type="unfinished">{who}: {total} ({date})</translation>
        </message>
        <message>
            <source>own best: {total} ({date})</source>
            <translation type="unfinished">eigener bester: {total} ({date})</translation>
        </message>
        <message>
            <source>own: {total} ({date})</source>
            <translation type="unfinished">eigener: {total} ({date})</translation>
        </message>
        <message>
            <source>ghost</source>
            <translation type="unfinished">Vergleich</translation>
        </message>
        <message>
            <source>ghost, {total:.0f} points</source>
            <translation type="unfinished">Vergleich, Punkte: {total:.0f}</translation>
        </message>
        <message>
            <source>The CT of this attempt is not open: no slices, no 3D.</source>
            <translation type="unfinished">Das CT dieses Versuchs ist nicht offen: keine Schichten, kein 3D.</translation>
        </message>
        <message>
            <source>Looking whether the open CT is that of the attempt…</source>
            <translation type="unfinished">Prüft, ob das offene CT das des Versuchs ist…</translation>
        </message>
        <message>
            <source>Looking at the CT of the attempt</source>
            <translation type="unfinished">CT des Versuchs wird geprüft</translation>
        </message>
        <message>
            <source>The CT that is open is not the one of this attempt: no slices, no 3D.</source>
            <translation type="unfinished">Das offene CT ist nicht das dieses Versuchs: keine Schichten, kein 3D.</translation>
        </message>
        <message>
            <source>The slices are made of the CT that was scanned, {ct}: open it first</source>
            <translation type="unfinished">Die Schichten stammen aus dem gescannten CT, {ct}: Öffnen Sie es zuerst</translation>
        </message>
        <message>
            <source>which is not open</source>
            <translation type="unfinished">das nicht offen ist</translation>
        </message>
        <message>
            <source>Making the slices again</source>
            <translation type="unfinished">Schichten werden neu berechnet</translation>
        </message>
        <message>
            <source>a student</source>
            <translation type="unfinished">ein Teilnehmer</translation>
        </message>
        <message>
            <source>and {n} more</source>
            <translation type="unfinished">und {n} weitere</translation>
        </message>
        <message>
            <source>The program ended in the middle of an attempt:</source>
            <translation type="unfinished">Das Programm endete mitten in einem Versuch:</translation>
        </message>
        <message>
            <source>The program ended in the middle of {n} attempts:</source>
            <translation type="unfinished">Das Programm endete mitten in {n} Versuchen:</translation>
        </message>
        <message>
            <source>Recover keeps what was recorded: it stays in the list as unfinished, without a score. Later changes nothing; the list of sessions offers it too.</source>
            <translation type="unfinished">Wiederherstellen behält, was aufgezeichnet wurde: Es bleibt als unvollendet in der Liste, ohne Bewertung. Später ändert nichts; die Liste der Sitzungen bietet es ebenfalls an.</translation>
        </message>
        <message>
            <source>Interrupted attempts</source>
            <translation type="unfinished">Unterbrochene Versuche</translation>
        </message>
        <message>
            <source>Recover</source>
            <translation type="unfinished">Wiederherstellen</translation>
        </message>
        <message>
            <source>Discard</source>
            <translation type="unfinished">Verwerfen</translation>
        </message>
        <message>
            <source>To the deleted ones; the instructor can bring it back</source>
            <translation type="unfinished">Zu den gelöschten; der Kursleiter kann ihn zurückholen</translation>
        </message>
        <message>
            <source>Later</source>
            <translation type="unfinished">Später</translation>
        </message>
        <message>
            <source>Saved {name}</source>
            <translation type="unfinished">{name} gespeichert</translation>
        </message>
        <message>
            <source>Past sessions</source>
            <translation type="unfinished">Frühere Sitzungen</translation>
        </message>
        <message>
            <source>Show this attempt as the demonstration</source>
            <translation type="unfinished">Diesen Versuch als Vorführung zeigen</translation>
        </message>
        <message>
            <source>Let the scripted expert show it again</source>
            <translation type="unfinished">Wieder vom automatischen Experten zeigen lassen</translation>
        </message>
        <message>
            <source>This exercise is no more what it was: begin it from the start page.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Show me now shows this attempt in {title}: its movement, without a name or score.</source>
            <translation type="unfinished">„Vormachen“ zeigt jetzt diesen Versuch in {title}: seine Bewegung, ohne Namen oder Bewertung.</translation>
        </message>
        <message>
            <source>Show me shows the scripted expert in {title}.</source>
            <translation type="unfinished">„Vormachen“ zeigt den automatischen Experten in {title}.</translation>
        </message>
        <message>
            <source>Bring earlier attempts here…</source>
            <translation type="unfinished">Frühere Versuche hierherholen…</translation>
        </message>
        <message>
            <source>Attempts of this station lie in {there}, where earlier versions kept them: {n}. Bring them to {here}? They are then no more in the other folder.</source>
            <translation type="unfinished">Versuche dieser Station liegen in {there}, wo frühere Versionen sie ablegten: {n}. Nach {here} holen? Im anderen Ordner sind sie dann nicht mehr.</translation>
        </message>
        <message>
            <source>Earlier attempts</source>
            <translation type="unfinished">Frühere Versuche</translation>
        </message>
        <message>
            <source>Earlier attempts lie in {there} ({n}): Sessions ▸ Bring earlier attempts here…</source>
            <translation type="unfinished">Frühere Versuche liegen in {there} ({n}): Sitzungen ▸ Frühere Versuche hierherholen…</translation>
        </message>
        <message>
            <source>1 attempt has come; it is in the list (F7).</source>
            <translation type="unfinished">1 Versuch ist angekommen; er steht in der Liste (F7).</translation>
        </message>
        <message>
            <source>{n} attempts have come; they are in the list (F7).</source>
            <translation type="unfinished">{n} Versuche sind angekommen; sie stehen in der Liste (F7).</translation>
        </message>
        <message>
            <source>vessel</source>
            <translation type="unfinished">Gefäß</translation>
        </message>
        <message>
            <source>lung</source>
            <translation type="unfinished">Lunge</translation>
        </message>
        <message>
            <source>gut</source>
            <translation type="unfinished">Darm</translation>
        </message>
        <message>
            <source>heart</source>
            <translation type="unfinished">Herz</translation>
        </message>
        <message>
            <source>organ</source>
            <translation type="unfinished">Organ</translation>
        </message>
        <message>
            <source>✖ This fails the attempt.</source>
            <translation type="unfinished">✖ Damit ist der Versuch nicht bestanden.</translation>
        </message>
        <message>
            <source>{met}, at {when}</source>
            <translation type="unfinished">{met}, bei {when}</translation>
        </message>
        <message>
            <source>met {n} times here</source>
            <translation type="unfinished">hier {n}-mal getroffen</translation>
        </message>
        <message>
            <source>longest way in it: {mm:.1f} mm</source>
            <translation type="unfinished">längster Weg darin: {mm:.1f} mm</translation>
        </message>
        <message>
            <source>largest force along the needle: {force:.1f} N</source>
            <translation type="unfinished">größte Kraft entlang der Nadel: {force:.1f} N</translation>
        </message>
        <message>
            <source>force along the needle: nobody felt it</source>
            <translation type="unfinished">Kraft entlang der Nadel: niemand hat sie gespürt</translation>
        </message>
        <message>
            <source>{angle:.0f}° from straight in</source>
            <translation type="unfinished">{angle:.0f}° vom senkrechten Durchtritt</translation>
        </message>
        <message>
            <source>mGy·cm
{estimate}</source>
            <translation type="unfinished">mGy·cm
{estimate}</translation>
        </message>
        <message>
            <source>Scan</source>
            <translation type="unfinished">Scan</translation>
        </message>
        <message>
            <source>Slices</source>
            <translation type="unfinished">Schichten</translation>
        </message>
        <message>
            <source>Shows</source>
            <translation type="unfinished">Zeigt</translation>
        </message>
        <message>
            <source>Enter or a double click shows its slices, if the CT is open</source>
            <translation type="unfinished">Eingabe oder Doppelklick zeigt seine Schichten, wenn das CT offen ist</translation>
        </message>
        <message>
            <source>{n} × {mm:g} mm, {low} to {high}</source>
            <translation type="unfinished">{n} × {mm:g} mm, {low} bis {high}</translation>
        </message>
        <message>
            <source>● tip</source>
            <translation type="unfinished">● Spitze</translation>
        </message>
        <message>
            <source>▲ shaft only</source>
            <translation type="unfinished">▲ nur Schaft</translation>
        </message>
        <message>
            <source>✖ no needle</source>
            <translation type="unfinished">✖ keine Nadel</translation>
        </message>
        <message>
            <source>Metric</source>
            <translation type="unfinished">Messgröße</translation>
        </message>
        <message>
            <source>Value</source>
            <translation type="unfinished">Wert</translation>
        </message>
        <message>
            <source>Band</source>
            <translation type="unfinished">Einstufung</translation>
        </message>
        <message>
            <source>Points</source>
            <translation type="unfinished">Punkte</translation>
        </message>
        <message>
            <source>Weight</source>
            <translation type="unfinished">Gewicht</translation>
        </message>
        <message>
            <source>Save report (PDF)</source>
            <translation type="unfinished">Bericht speichern (PDF)</translation>
        </message>
        <message>
            <source>Export CSV</source>
            <translation type="unfinished">CSV exportieren</translation>
        </message>
        <message>
            <source>Again</source>
            <translation type="unfinished">Noch einmal</translation>
        </message>
        <message>
            <source>Sessions</source>
            <translation type="unfinished">Sitzungen</translation>
        </message>
        <message>
            <source>Closest to structures of risk</source>
            <translation type="unfinished">Nächste Annäherung an Risikostrukturen</translation>
        </message>
        <message>
            <source>What the needle met, with the force along the needle</source>
            <translation type="unfinished">Was die Nadel getroffen hat, mit der Kraft längs der Nadel</translation>
        </message>
        <message>
            <source>Next: {title}</source>
            <translation type="unfinished">Weiter: {title}</translation>
        </message>
        <message>
            <source>All metrics</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Every metric with its value, band and points; remembered</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Drill, {drill}: {title}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>control scans: {n}</source>
            <translation type="unfinished">Kontrollscans: {n}</translation>
        </message>
        <message>
            <source>Track of the tip, seen along the planned path; a square where it began, a diamond where it ended; the arrow is the force at the hand</source>
            <translation type="unfinished">Spur der Spitze, entlang des geplanten Pfads gesehen; ein Quadrat, wo sie begann, eine Raute, wo sie endete; der Pfeil ist die Kraft an der Hand</translation>
        </message>
        <message>
            <source>{force:.1f} N</source>
            <translation type="unfinished">{force:.1f} N</translation>
        </message>
        <message>
            <source>Rates of published series of patients, with their sources: not the probability for this patient, and no part of the score</source>
            <translation type="unfinished">Raten veröffentlichter Patientenserien mit ihren Quellen: nicht die Wahrscheinlichkeit für diesen Patienten und kein Teil der Bewertung</translation>
        </message>
        <message>
            <source>Published risks of what was met</source>
            <translation type="unfinished">Veröffentlichte Risiken des Getroffenen</translation>
        </message>
        <message>
            <source>Declared void by the instructor: {why}</source>
            <translation type="unfinished">Vom Kursleiter für ungültig erklärt: {why}</translation>
        </message>
        <message>
            <source>The instructor says: {words}</source>
            <translation type="unfinished">Der Kursleiter sagt: {words}</translation>
        </message>
        <message>
            <source>Not released: the student sees no result yet (course {name})</source>
            <translation type="unfinished">Nicht freigegeben: Der Teilnehmer sieht noch kein Ergebnis (Kurs {name})</translation>
        </message>
        <message>
            <source>Instructor</source>
            <translation type="unfinished">Kursleiter</translation>
        </message>
        <message>
            <source>Comment on the selected attempts, declare them void, release their results</source>
            <translation type="unfinished">Ausgewählte Versuche kommentieren, für ungültig erklären, ihre Ergebnisse freigeben</translation>
        </message>
        <message>
            <source>Comment…</source>
            <translation type="unfinished">Kommentieren…</translation>
        </message>
        <message>
            <source>Say something that the student reads in the debrief</source>
            <translation type="unfinished">Etwas sagen, das der Teilnehmer in der Nachbesprechung liest</translation>
        </message>
        <message>
            <source>Declare void…</source>
            <translation type="unfinished">Für ungültig erklären…</translation>
        </message>
        <message>
            <source>It stays in the list but does not count; the student can read the reason</source>
            <translation type="unfinished">Er bleibt in der Liste, zählt aber nicht; der Teilnehmer kann den Grund lesen</translation>
        </message>
        <message>
            <source>Let it count again</source>
            <translation type="unfinished">Wieder zählen lassen</translation>
        </message>
        <message>
            <source>Take back that it was declared void</source>
            <translation type="unfinished">Nimmt zurück, dass er für ungültig erklärt wurde</translation>
        </message>
        <message>
            <source>Release the result</source>
            <translation type="unfinished">Ergebnis freigeben</translation>
        </message>
        <message>
            <source>Let the student see score and replay</source>
            <translation type="unfinished">Den Teilnehmer Bewertung und Wiedergabe sehen lassen</translation>
        </message>
        <message>
            <source>Hold the result back</source>
            <translation type="unfinished">Ergebnis zurückhalten</translation>
        </message>
        <message>
            <source>Hide it again until it is released</source>
            <translation type="unfinished">Wieder verbergen, bis es freigegeben wird</translation>
        </message>
        <message>
            <source>Admit…</source>
            <translation type="unfinished">Anerkennen…</translation>
        </message>
        <message>
            <source>Let an attempt count that this station has not signed; the reason is sealed</source>
            <translation type="unfinished">Einen Versuch zählen lassen, den diese Station nicht signiert hat; der Grund wird versiegelt</translation>
        </message>
        <message>
            <source>It counts again</source>
            <translation type="unfinished">Zählt wieder</translation>
        </message>
        <message>
            <source>Released</source>
            <translation type="unfinished">Freigegeben</translation>
        </message>
        <message>
            <source>Held back</source>
            <translation type="unfinished">Zurückgehalten</translation>
        </message>
        <message>
            <source>The student reads this in the debrief and in the list. Empty: none.</source>
            <translation type="unfinished">Der Teilnehmer liest das in der Nachbesprechung und in der Liste. Leer: keiner.</translation>
        </message>
        <message>
            <source>Comment</source>
            <translation type="unfinished">Kommentar</translation>
        </message>
        <message>
            <source>It will not count: not on the board, in any curve or for any course. The record stays, and this can be undone. Why? The student can read the reason.</source>
            <translation type="unfinished">Er wird nicht zählen: nicht in der Übersicht, in keiner Kurve und für keinen Kurs. Die Aufzeichnung bleibt, und Sie können das rückgängig machen. Warum? Der Teilnehmer kann den Grund lesen.</translation>
        </message>
        <message>
            <source>Declare void</source>
            <translation type="unfinished">Für ungültig erklären</translation>
        </message>
        <message>
            <source>This station did not sign it: it counts on no board and for no course. Why is it to count all the same? The reason is sealed with the record as it is now.</source>
            <translation type="unfinished">Diese Station hat ihn nicht signiert: Er zählt in keiner Übersicht und für keinen Kurs. Warum soll er trotzdem zählen? Der Grund wird mit der Aufzeichnung, wie sie jetzt ist, versiegelt.</translation>
        </message>
        <message>
            <source>Admit</source>
            <translation type="unfinished">Anerkennen</translation>
        </message>
        <message>
            <source>Comment kept</source>
            <translation type="unfinished">Kommentar gespeichert</translation>
        </message>
        <message>
            <source>Comment removed</source>
            <translation type="unfinished">Kommentar entfernt</translation>
        </message>
        <message>
            <source>Say why: the student reads it in the list and in the debrief.</source>
            <translation type="unfinished">Sagen Sie, warum: Der Teilnehmer liest es in der Liste und in der Nachbesprechung.</translation>
        </message>
        <message>
            <source>{n} attempts declared void</source>
            <translation type="unfinished">{n} Versuche für ungültig erklärt</translation>
        </message>
        <message>
            <source>1 attempt declared void</source>
            <translation type="unfinished">1 Versuch für ungültig erklärt</translation>
        </message>
        <message>
            <source>Only the instructor does that: Sessions ▸ Sign in.</source>
            <translation type="unfinished">Das darf nur der Kursleiter: Sitzungen ▸ Anmelden.</translation>
        </message>
        <message>
            <source>{n} attempts admitted</source>
            <translation type="unfinished">{n} Versuche anerkannt</translation>
        </message>
        <message>
            <source>1 attempt admitted</source>
            <translation type="unfinished">1 Versuch anerkannt</translation>
        </message>
        <message>
            <source>{done}: {n} attempts</source>
            <translation type="unfinished">{done}: {n} Versuche</translation>
        </message>
        <message>
            <source>{done}: 1 attempt</source>
            <translation type="unfinished">{done}: 1 Versuch</translation>
        </message>
        <message>
            <source>Place in the attempt</source>
            <translation type="unfinished">Stelle im Versuch</translation>
        </message>
        <message>
            <source>nothing</source>
            <translation type="unfinished">nichts</translation>
        </message>
        <message>
            <source>How fast it is played</source>
            <translation type="unfinished">Wie schnell es abläuft</translation>
        </message>
        <message>
            <source>along the needle</source>
            <translation type="unfinished">entlang der Nadel</translation>
        </message>
        <message>
            <source>along the planned path</source>
            <translation type="unfinished">entlang des geplanten Pfads</translation>
        </message>
        <message>
            <source>Where the two slices lie</source>
            <translation type="unfinished">Wo die beiden Schichten liegen</translation>
        </message>
        <message>
            <source>at the same time</source>
            <translation type="unfinished">zur gleichen Zeit</translation>
        </message>
        <message>
            <source>at the same depth</source>
            <translation type="unfinished">in gleicher Tiefe</translation>
        </message>
        <message>
            <source>What is shown beside the needle: dotted in slices and curves, dashed in 3D</source>
            <translation type="unfinished">Was neben der Nadel gezeigt wird: gepunktet in Schichten und Kurven, gestrichelt in 3D</translation>
        </message>
        <message>
            <source>By what the two attempts are brought together</source>
            <translation type="unfinished">Wonach die beiden Versuche zusammengeführt werden</translation>
        </message>
        <message>
            <source>Space plays and pauses; the arrows go on and back, with Shift farther; Home, End</source>
            <translation type="unfinished">Die Leertaste spielt ab und hält an; die Pfeiltasten gehen vor und zurück, mit Umschalt weiter; Pos1, Ende</translation>
        </message>
        <message>
            <source>Speed</source>
            <translation type="unfinished">Tempo</translation>
        </message>
        <message>
            <source>Beside it</source>
            <translation type="unfinished">Daneben</translation>
        </message>
        <message>
            <source>Aligned</source>
            <translation type="unfinished">Abgeglichen</translation>
        </message>
        <message>
            <source>❚❚ Pause</source>
            <translation type="unfinished">❚❚ Pause</translation>
        </message>
        <message>
            <source>▶ Play</source>
            <translation type="unfinished">▶ Abspielen</translation>
        </message>
        <message>
            <source>Open its CT…</source>
            <translation type="unfinished">CT dazu öffnen…</translation>
        </message>
        <message>
            <source>{mm:g} mm</source>
            <translation type="unfinished">{mm:g} mm</translation>
        </message>
        <message>
            <source>Acus attempt {id}</source>
            <translation type="unfinished">Acus-Versuch {id}</translation>
        </message>
        <message>
            <source>Report of an attempt</source>
            <translation type="unfinished">Bericht über einen Versuch</translation>
        </message>
        <message>
            <source>Watched by (pseudonym)</source>
            <translation type="unfinished">Zugesehen hat (Pseudonym)</translation>
        </message>
        <message>
            <source>Student (pseudonym)</source>
            <translation type="unfinished">Teilnehmer (Pseudonym)</translation>
        </message>
        <message>
            <source>Date</source>
            <translation type="unfinished">Datum</translation>
        </message>
        <message>
            <source>Session</source>
            <translation type="unfinished">Sitzung</translation>
        </message>
        <message>
            <source>Duration</source>
            <translation type="unfinished">Dauer</translation>
        </message>
        <message>
            <source>Path</source>
            <translation type="unfinished">Pfad</translation>
        </message>
        <message>
            <source>{mm:.1f} mm from entry to target</source>
            <translation type="unfinished">{mm:.1f} mm vom Einstichpunkt bis zum Ziel</translation>
        </message>
        <message>
            <source>Tip measured to</source>
            <translation type="unfinished">Spitze gemessen auf</translation>
        </message>
        <message>
            <source>Recorded with</source>
            <translation type="unfinished">Aufgezeichnet mit</translation>
        </message>
        <message>
            <source>Made under</source>
            <translation type="unfinished">Bedingungen</translation>
        </message>
        <message>
            <source>{n}, {tips} of them with the tip; {dose:.1f} mGy·cm ({estimate})</source>
            <translation type="unfinished">{n}, davon mit Spitze: {tips}; {dose:.1f} mGy·cm ({estimate})</translation>
        </message>
        <message>
            <source>not recorded</source>
            <translation type="unfinished">nicht aufgezeichnet</translation>
        </message>
        <message>
            <source>± {mm:.1f} mm (95 %), median</source>
            <translation type="unfinished">± {mm:.1f} mm (95 %), Median</translation>
        </message>
        <message>
            <source>* required to pass</source>
            <translation type="unfinished">* zum Bestehen nötig</translation>
        </message>
        <message>
            <source>Course of the attempt</source>
            <translation type="unfinished">Verlauf des Versuchs</translation>
        </message>
        <message>
            <source>Track of the tip, seen along the planned path</source>
            <translation type="unfinished">Spur der Spitze, entlang des geplanten Pfads gesehen</translation>
        </message>
        <message>
            <source>□ where it began   ◆ where it ended
Rings: {expert:g} mm expert, {passing:g} mm pass
Letters: directions of the patient
▼ control scan</source>
            <translation type="unfinished">□ wo sie begann   ◆ wo sie endete
Ringe: {expert:g} mm Experte, {passing:g} mm bestanden
Buchstaben: Richtungen des Patienten
▼ Kontrollscan</translation>
        </message>
        <message>
            <source>page {page} of 2</source>
            <translation type="unfinished">Seite {page} von 2</translation>
        </message>
        <message>
            <source>✖ {name}: needle inside, {depth:.1f} mm deep, at {when} (limit {limit:g} mm)</source>
            <translation type="unfinished">✖ {name}: Nadel darin, {depth:.1f} mm tief, bei {when} (Grenze {limit:g} mm)</translation>
        </message>
        <message>
            <source>▲ {name}: {distance:.1f} mm, at {when}: nearer than {limit:g} mm</source>
            <translation type="unfinished">▲ {name}: {distance:.1f} mm, bei {when}: näher als {limit:g} mm</translation>
        </message>
        <message>
            <source>✔ {name}: {distance:.1f} mm, at {when} (limit {limit:g} mm)</source>
            <translation type="unfinished">✔ {name}: {distance:.1f} mm, bei {when} (Grenze {limit:g} mm)</translation>
        </message>
        <message>
            <source>real robot</source>
            <translation type="unfinished">echter Roboter</translation>
        </message>
        <message>
            <source>emulated robot</source>
            <translation type="unfinished">emulierter Roboter</translation>
        </message>
        <message>
            <source>simulated robot</source>
            <translation type="unfinished">simulierter Roboter</translation>
        </message>
        <message>
            <source>pen and webcam</source>
            <translation type="unfinished">Stift und Webcam</translation>
        </message>
        <message>
            <source>robot not known</source>
            <translation type="unfinished">Roboter unbekannt</translation>
        </message>
        <message>
            <source>script ({skill})</source>
            <translation type="unfinished">Skript ({skill})</translation>
        </message>
        <message>
            <source>mouse</source>
            <translation type="unfinished">Maus</translation>
        </message>
        <message>
            <source>keyboard</source>
            <translation type="unfinished">Tastatur</translation>
        </message>
        <message>
            <source>tablet</source>
            <translation type="unfinished">Grafiktablett</translation>
        </message>
        <message>
            <source>gamepad</source>
            <translation type="unfinished">Gamepad</translation>
        </message>
        <message>
            <source>hand at the robot</source>
            <translation type="unfinished">Hand am Roboter</translation>
        </message>
        <message>
            <source>pen</source>
            <translation type="unfinished">Stift</translation>
        </message>
        <message>
            <source>script</source>
            <translation type="unfinished">Skript</translation>
        </message>
        <message>
            <source>the arm (simulation)</source>
            <translation type="unfinished">der Arm (Simulation)</translation>
        </message>
        <message>
            <source>{first}, then {later}</source>
            <translation type="unfinished">{first}, dann {later}</translation>
        </message>
        <message>
            <source>◇ Begun by the arm (simulation), then taken over by {hand}: not a student's attempt, it is not scored for anyone</source>
            <translation type="unfinished">◇ Vom Arm begonnen (Simulation), dann übernommen ({hand}): kein Versuch eines Teilnehmers, er wird für niemanden bewertet</translation>
        </message>
        <message>
            <source>◇ Carried out by the arm (simulation), not by a student: it is not scored for anyone</source>
            <translation type="unfinished">◇ Vom Arm ausgeführt (Simulation), nicht von einem Teilnehmer: Er wird für niemanden bewertet</translation>
        </message>
        <message>
            <source>◇ no student's</source>
            <translation type="unfinished">◇ von keinem Teilnehmer</translation>
        </message>
        <message>
            <source>assistance {dial}</source>
            <translation type="unfinished">Unterstützung {dial}</translation>
        </message>
        <message>
            <source>▲ model changed meanwhile: {models}</source>
            <translation type="unfinished">▲ Modell zwischendurch gewechselt: {models}</translation>
        </message>
        <message>
            <source>Hand and robot</source>
            <translation type="unfinished">Hand und Roboter</translation>
        </message>
        <message>
            <source>Computer</source>
            <translation type="unfinished">Computer</translation>
        </message>
        <message>
            <source>Models changed meanwhile</source>
            <translation type="unfinished">Zwischendurch gewechselte Modelle</translation>
        </message>
        <message>
            <source>Software</source>
            <translation type="unfinished">Software</translation>
        </message>
        <message>
            <source>{start} as set, throughout</source>
            <translation type="unfinished">durchgehend {start}, wie eingestellt</translation>
        </message>
        <message>
            <source>set {start}; least {least:z.2f}, most {most:z.2f}, over time {mean:z.2f}</source>
            <translation type="unfinished">eingestellt {start}; kleinste {least:z.2f}, größte {most:z.2f}, zeitlich gemittelt {mean:z.2f}</translation>
        </message>
        <message>
            <source>simulated cameras</source>
            <translation type="unfinished">simulierte Kameras</translation>
        </message>
        <message>
            <source>calibration {id}</source>
            <translation type="unfinished">Kalibrierung {id}</translation>
        </message>
        <message>
            <source>no calibration</source>
            <translation type="unfinished">keine Kalibrierung</translation>
        </message>
        <message>
            <source>not checked; {calibration}</source>
            <translation type="unfinished">nicht kontrolliert; {calibration}</translation>
        </message>
        <message>
            <source>agree within {mm:.1f} mm (95 %); {calibration}</source>
            <translation type="unfinished">stimmen auf {mm:.1f} mm überein (95 %); {calibration}</translation>
        </message>
        <message>
            <source>version {n}</source>
            <translation type="unfinished">Version {n}</translation>
        </message>
        <message>
            <source>version not recorded</source>
            <translation type="unfinished">Version nicht aufgezeichnet</translation>
        </message>
        <message>
            <source>level {n}</source>
            <translation type="unfinished">Stufe {n}</translation>
        </message>
        <message>
            <source>none</source>
            <translation type="unfinished">keine</translation>
        </message>
        <message>
            <source>scoring version {n}</source>
            <translation type="unfinished">Bewertungsversion {n}</translation>
        </message>
        <message>
            <source>seed {n}</source>
            <translation type="unfinished">Startwert {n}</translation>
        </message>
        <message>
            <source>fail</source>
            <translation type="unfinished">nicht bestanden</translation>
        </message>
        <message>
            <source>Smoothness</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Largest distance from the path</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Mean distance from the path</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Void: not judged.</source>
            <translation type="unfinished">Ungültig: nicht beurteilt.</translation>
        </message>
        <message>
            <source>to the left</source>
            <translation type="unfinished">nach links</translation>
        </message>
        <message>
            <source>to the right</source>
            <translation type="unfinished">nach rechts</translation>
        </message>
        <message>
            <source>to the patient's left</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>to the patient's right</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>towards the back</source>
            <translation type="unfinished">nach hinten</translation>
        </message>
        <message>
            <source>towards the front</source>
            <translation type="unfinished">nach vorn</translation>
        </message>
        <message>
            <source>towards the head</source>
            <translation type="unfinished">zum Kopf hin</translation>
        </message>
        <message>
            <source>towards the feet</source>
            <translation type="unfinished">zu den Füßen hin</translation>
        </message>
        <message>
            <source>{side} and {other_side}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>At {depth:.0f} mm depth you were {mm:.1f} mm off the line {where}.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>From {depth:.0f} mm depth on you were off the line {where}, by up to {mm:.1f} mm.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>You left the line between {low:.0f} and {high:.0f} mm depth {where}, by up to {mm:.1f} mm.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>At the skin the needle was in line: {tilt:.1f}° off.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>The tilt at the skin was {tilt:.1f}° off: the tip pointed too far {where}.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>The tip ended {mm:.1f} mm too deep.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>The tip ended {mm:.1f} mm too deep: it passed the target's depth at {clock}.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>The tip was {mm:.1f} mm too deep at {clock}, then drawn back to {short:.1f} mm short of the target.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>The tip stopped {mm:.1f} mm short of the target; it came no deeper after {clock}.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>You pushed {outside:.0f} of {whole:.0f} mm while the breath had moved the target by more than {gate:.1f} mm.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{stage} took longest against its band: {seconds:.0f} s, of which {good:.0f} s are good.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{stage} took longest: {seconds:.0f} of {whole:.0f} s.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Holding still</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>The force was largest at {clock}: {newton:.1f} N.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>The force was largest at {depth:.0f} mm depth, at {clock}: {newton:.1f} N.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{met}, at {clock}.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>The needle was inside {name} at {clock}, with its tip at {depth:.0f} mm depth.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>The needle came within {mm:.1f} mm of {name} at {clock}, with its tip at {depth:.0f} mm depth.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{outside} of {n} control scans were taken before the needle was in the skin.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{mm:.1f} mm {side}</source>
            <translation type="unfinished">{mm:.1f} mm {side}</translation>
        </message>
        <message>
            <source>at its depth</source>
            <translation type="unfinished">in seiner Tiefe</translation>
        </message>
        <message>
            <source>{mm:.1f} mm too deep</source>
            <translation type="unfinished">{mm:.1f} mm zu tief</translation>
        </message>
        <message>
            <source>{mm:.1f} mm short of it</source>
            <translation type="unfinished">{mm:.1f} mm davor</translation>
        </message>
        <message>
            <source>The needle ended {mm:.1f} mm beside the target{where}, and {along}.</source>
            <translation type="unfinished">Die Nadel wich am Ende {mm:.1f} mm vom Ziel{where} ab und lag {along}.</translation>
        </message>
        <message>
            <source>The target was missed: all else counts only {share:.0f} %.</source>
            <translation type="unfinished">Das Ziel wurde verfehlt: Alles andere zählt nur {share:.0f} %.</translation>
        </message>
        <message>
            <source>You turned the needle by {angle:.1f}° at {depth:.0f} mm depth.</source>
            <translation type="unfinished">Sie haben die Nadel in {depth:.0f} mm Tiefe um {angle:.1f}° gedreht.</translation>
        </message>
        <message>
            <source>The same turn at {earlier:.0f} mm takes {share:.0f} % of the side force.</source>
            <translation type="unfinished">Dieselbe Drehung bei {earlier:.0f} mm braucht {share:.0f} % der Seitenkraft.</translation>
        </message>
        <message>
            <source>align only</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>depth only</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>breath</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>ten times three minutes</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{drill} It counts for no course and no pass.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Practise: {drill}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Nothing cost points.</source>
            <translation type="unfinished">Nichts hat Punkte gekostet.</translation>
        </message>
        <message>
            <source>{label}: {value} cost {points}; {expert} or more costs none.</source>
            <translation type="unfinished">{label}: {value} kostete {points}; ab {expert} kostet es nichts.</translation>
        </message>
        <message>
            <source>{label}: {value} cost {points}; {expert} or less costs none.</source>
            <translation type="unfinished">{label}: {value} kostete {points}; bis {expert} kostet es nichts.</translation>
        </message>
        <message>
            <source>1 point</source>
            <translation type="unfinished">1 Punkt</translation>
        </message>
        <message>
            <source>{n} points</source>
            <translation type="unfinished">{n} Punkte</translation>
        </message>
        <message>
            <source> {metric} cost most: {points}.</source>
            <translation type="unfinished"> Am meisten hat gekostet: {metric} ({points}).</translation>
        </message>
        <message>
            <source>Next: {title}.</source>
            <translation type="unfinished">Weiter: {title}.</translation>
        </message>
        <message>
            <source> It follows in the course {course}.</source>
            <translation type="unfinished"> Sie folgt im Kurs {course}.</translation>
        </message>
        <message>
            <source> This one is passed; it is of level {level}.</source>
            <translation type="unfinished"> Diese ist bestanden; die nächste hat Stufe {level}.</translation>
        </message>
        <message>
            <source> This one is passed; {metric} cost most here ({points}), and counts there.</source>
            <translation type="unfinished"> Diese ist bestanden; am meisten gekostet hat hier {metric} ({points}), und das zählt dort.</translation>
        </message>
        <message>
            <source>The same again: it is not passed yet.</source>
            <translation type="unfinished">Noch einmal dieselbe: Sie ist noch nicht bestanden.</translation>
        </message>
        <message>
            <source> {n} attempts in a row did not pass; this one is of level {level}.</source>
            <translation type="unfinished"> {n} Versuche hintereinander waren nicht bestanden; diese hat Stufe {level}.</translation>
        </message>
        <message>
            <source>Now you: {title}.</source>
            <translation type="unfinished">Jetzt Sie: {title}.</translation>
        </message>
        <message>
            <source>Then the whole exercise: {title}.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>The same again: this attempt has no points.</source>
            <translation type="unfinished">Noch einmal dieselbe: Dieser Versuch hat keine Punkte.</translation>
        </message>
        <message>
            <source>All exercises that are open to you are passed.</source>
            <translation type="unfinished">Alle Übungen, die Ihnen offenstehen, sind bestanden.</translation>
        </message>
        <message>
            <source>not scored</source>
            <translation type="unfinished">nicht bewertet</translation>
        </message>
        <message>
            <source>{total:.0f} of 100 points</source>
            <translation type="unfinished">{total:.0f} von 100 Punkten</translation>
        </message>
        <message>
            <source>▲ Void</source>
            <translation type="unfinished">▲ Ungültig</translation>
        </message>
        <message>
            <source>{why} It does not count.</source>
            <translation type="unfinished">{why} Er zählt nicht.</translation>
        </message>
        <message>
            <source>This attempt was not scored.</source>
            <translation type="unfinished">Dieser Versuch wurde nicht bewertet.</translation>
        </message>
        <message>
            <source>✔ Passed</source>
            <translation type="unfinished">✔ Bestanden</translation>
        </message>
        <message>
            <source>✔ Reached</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Required and not met: {names}</source>
            <translation type="unfinished">Verlangt und nicht erreicht: {names}</translation>
        </message>
        <message>
            <source>{mark:g} points are needed</source>
            <translation type="unfinished">Nötige Punkte: {mark:g}</translation>
        </message>
        <message>
            <source>✖ Not passed</source>
            <translation type="unfinished">✖ Nicht bestanden</translation>
        </message>
        <message>
            <source>✖ Not reached yet</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>It counts for nothing. The pictures of the simulated cameras came too late: this computer was too busy. Close other programs, then try again.</source>
            <translation type="unfinished">Er zählt nicht. Die Bilder der simulierten Kameras kamen zu spät: Dieser Computer war zu stark ausgelastet. Schließen Sie andere Programme und versuchen Sie es noch einmal.</translation>
        </message>
        <message>
            <source>It does not count and does not affect any average; fix what is named, if anything, and try again.</source>
            <translation type="unfinished">Er zählt nicht und ändert keinen Durchschnitt; beheben Sie, was gegebenenfalls genannt ist, und versuchen Sie es noch einmal.</translation>
        </message>
        <message>
            <source>It counts for nothing. Let both cameras see the marker (the tab Cameras says what each one lacks: light, something before it, the colour), then try again.</source>
            <translation type="unfinished">Er zählt nicht. Lassen Sie beide Kameras den Marker sehen (der Reiter Kameras sagt, was jeder fehlt: Licht, etwas davor, die Farbe) und versuchen Sie es noch einmal.</translation>
        </message>
        <message>
            <source>Shown for information; it does not count.</source>
            <translation type="unfinished">Nur zur Information; zählt nicht.</translation>
        </message>
        <message>
            <source>expert {expert:g}, good {good:g}, pass {passing:g} {unit}</source>
            <translation type="unfinished">Experte {expert:g}, gut {good:g}, bestanden {passing:g} {unit}</translation>
        </message>
        <message>
            <source>{n} days left</source>
            <translation type="unfinished">Tage übrig: {n}</translation>
        </message>
        <message>
            <source>void: {why}</source>
            <translation type="unfinished">ungültig: {why}</translation>
        </message>
        <message>
            <source>not released</source>
            <translation type="unfinished">nicht freigegeben</translation>
        </message>
        <message>
            <source>cut off</source>
            <translation type="unfinished">unterbrochen</translation>
        </message>
        <message>
            <source>cut off: Recover closes it as it is</source>
            <translation type="unfinished">unterbrochen: Wiederherstellen schließt ihn ab, wie er ist</translation>
        </message>
        <message>
            <source>deleted; can be brought back for {n} days</source>
            <translation type="unfinished">gelöscht; lässt sich zurückholen (Tage übrig: {n})</translation>
        </message>
        <message>
            <source>deleted; can be brought back until the trash is emptied</source>
            <translation type="unfinished">gelöscht; lässt sich zurückholen, bis der Papierkorb geleert wird</translation>
        </message>
        <message>
            <source>Student</source>
            <translation type="unfinished">Teilnehmer</translation>
        </message>
        <message>
            <source>Made with</source>
            <translation type="unfinished">Gemacht mit</translation>
        </message>
        <message>
            <source>Signature</source>
            <translation type="unfinished">Signatur</translation>
        </message>
        <message>
            <source>void</source>
            <translation type="unfinished">ungültig</translation>
        </message>
        <message>
            <source>held</source>
            <translation type="unfinished">gehalten</translation>
        </message>
        <message>
            <source>The instructor releases this result of the course {course}.</source>
            <translation type="unfinished">Der Kursleiter gibt dieses Ergebnis des Kurses {course} frei.</translation>
        </message>
        <message>
            <source>verified</source>
            <translation type="unfinished">bestätigt</translation>
        </message>
        <message>
            <source>altered</source>
            <translation type="unfinished">verändert</translation>
        </message>
        <message>
            <source>unsigned</source>
            <translation type="unfinished">nicht signiert</translation>
        </message>
        <message>
            <source>admitted</source>
            <translation type="unfinished">anerkannt</translation>
        </message>
        <message>
            <source>Drill: {title}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{title} (version {n})</source>
            <translation type="unfinished">{title} (Version {n})</translation>
        </message>
        <message>
            <source>Open</source>
            <translation type="unfinished">Öffnen</translation>
        </message>
        <message>
            <source>Delete</source>
            <translation type="unfinished">Löschen</translation>
        </message>
        <message>
            <source>Undo delete</source>
            <translation type="unfinished">Löschen zurück</translation>
        </message>
        <message>
            <source>Show deleted</source>
            <translation type="unfinished">Gelöschte zeigen</translation>
        </message>
        <message>
            <source>Bring back</source>
            <translation type="unfinished">Zurückholen</translation>
        </message>
        <message>
            <source>{words}  ✕</source>
            <translation type="unfinished">{words}  ✕</translation>
        </message>
        <message>
            <source>Show all attempts again</source>
            <translation type="unfinished">Wieder alle Versuche zeigen</translation>
        </message>
        <message>
            <source>Back to the attempts</source>
            <translation type="unfinished">Zurück zu den Versuchen</translation>
        </message>
        <message>
            <source>{n} deleted: Ctrl+Z here, or Show deleted, brings back</source>
            <translation type="unfinished">{n} gelöscht: Strg+Z hier oder „Gelöschte zeigen“ holt zurück</translation>
        </message>
        <message>
            <source>{n} brought back</source>
            <translation type="unfinished">{n} zurückgeholt</translation>
        </message>
        <message>
            <source>{n} recovered: listed as unfinished, without a score</source>
            <translation type="unfinished">{n} wiederhergestellt: als unvollendet in der Liste, ohne Bewertung</translation>
        </message>
        <message>
            <source>{n} discarded: Show deleted brings them back</source>
            <translation type="unfinished">{n} verworfen: „Gelöschte zeigen“ holt zurück</translation>
        </message>
        <message>
            <source>No sessions yet: begin an attempt, and it will be listed here.</source>
            <translation type="unfinished">Noch keine Sitzungen: Beginnen Sie einen Versuch, dann steht er hier.</translation>
        </message>
        <message>
            <source>Nothing that was deleted is left.</source>
            <translation type="unfinished">Von den gelöschten ist nichts mehr da.</translation>
        </message>
        <message>
            <source>No attempt of these yet.</source>
            <translation type="unfinished">Davon gibt es noch keinen Versuch.</translation>
        </message>
        <message>
            <source>{shown} of {total} sessions</source>
            <translation type="unfinished">{shown} von {total} Sitzungen</translation>
        </message>
        <message>
            <source>Filter by student, exercise, date, state…</source>
            <translation type="unfinished">Nach Teilnehmer, Übung, Datum, Zustand filtern…</translation>
        </message>
        <message>
            <source>Debrief with replay (double click, or Enter)</source>
            <translation type="unfinished">Nachbesprechung mit Wiedergabe (Doppelklick oder Eingabe)</translation>
        </message>
        <message>
            <source>To the deleted ones, for {n} days at least (Del)</source>
            <translation type="unfinished">Zu den gelöschten, für mindestens {n} Tage (Entf)</translation>
        </message>
        <message>
            <source>Bring the last deleted ones back (Ctrl+Z in the table)</source>
            <translation type="unfinished">Die zuletzt gelöschten zurückholen (Strg+Z in der Tabelle)</translation>
        </message>
        <message>
            <source>The program was killed in this attempt: keep what was recorded, as unfinished</source>
            <translation type="unfinished">Das Programm wurde in diesem Versuch beendet: das Aufgezeichnete als unvollendet behalten</translation>
        </message>
        <message>
            <source>What was deleted, to be brought back</source>
            <translation type="unfinished">Was gelöscht wurde, zum Zurückholen</translation>
        </message>
        <message>
            <source>How the robot helps. To the right it guides the needle back to the planned path, to the left it pushes the needle away from it, which is harder to master; in the middle it does nothing. Arrow keys 1 %, Page keys 10 %, Home or double click: off.</source>
            <translation type="unfinished">Wie der Roboter hilft. Nach rechts führt er die Nadel zum geplanten Pfad zurück, nach links drückt er sie davon weg, was schwerer zu beherrschen ist; in der Mitte tut er nichts. Pfeiltasten 1 %, Bildtasten 10 %, Pos1 oder Doppelklick: aus.</translation>
        </message>
        <message>
            <source>○ off</source>
            <translation type="unfinished">○ aus</translation>
        </message>
        <message>
            <source>▶◀ guides {percent} %</source>
            <translation type="unfinished">▶◀ führt {percent} %</translation>
        </message>
        <message>
            <source>◀▶ repels {percent} %</source>
            <translation type="unfinished">◀▶ drückt weg {percent} %</translation>
        </message>
        <message>
            <source>repel</source>
            <translation type="unfinished">wegdrücken</translation>
        </message>
        <message>
            <source>off</source>
            <translation type="unfinished">aus</translation>
        </message>
        <message>
            <source>guide</source>
            <translation type="unfinished">führen</translation>
        </message>
        <message>
            <source>Force of the tissue along the needle, as the simulation has it: friction on the shaft. The robot cannot push along the needle; a simulated hand feels it.</source>
            <translation type="unfinished">Kraft des Gewebes entlang der Nadel, wie die Simulation sie hat: Reibung am Schaft. Der Roboter kann nicht entlang der Nadel drücken; eine simulierte Hand spürt sie.</translation>
        </message>
        <message>
            <source>Bone crossed by {way:.1f} mm</source>
            <translation type="unfinished">Knochen auf {way:.1f} mm durchquert</translation>
        </message>
        <message>
            <source>Along the needle: the tip stands on bone ▶</source>
            <translation type="unfinished">Entlang der Nadel: Die Spitze steht auf Knochen ▶</translation>
        </message>
        <message>
            <source>Force along the needle: not known</source>
            <translation type="unfinished">Kraft entlang der Nadel: nicht bekannt</translation>
        </message>
        <message>
            <source>Force along the needle: none</source>
            <translation type="unfinished">Kraft entlang der Nadel: keine</translation>
        </message>
        <message>
            <source>Along the needle: tissue pushes it out ▶</source>
            <translation type="unfinished">Entlang der Nadel: Gewebe drückt sie heraus ▶</translation>
        </message>
        <message>
            <source>Along the needle: tissue holds it back ◀</source>
            <translation type="unfinished">Entlang der Nadel: Gewebe hält sie zurück ◀</translation>
        </message>
        <message>
            <source>An attempt is running: end it before another exercise is begun</source>
            <translation type="unfinished">Ein Versuch läuft: Beenden Sie ihn, bevor Sie eine andere Übung beginnen</translation>
        </message>
        <message>
            <source>There is no exercise {name} any more.</source>
            <translation type="unfinished">Die Übung {name} gibt es nicht mehr.</translation>
        </message>
        <message>
            <source>Place entry and target first: the expert follows your plan.</source>
            <translation type="unfinished">Setzen Sie zuerst Einstichpunkt und Ziel: Der Experte folgt Ihrem Plan.</translation>
        </message>
        <message>
            <source>The demonstration is coming …</source>
            <translation type="unfinished">Die Vorführung kommt …</translation>
        </message>
        <message>
            <source>Demonstration: a recorded attempt is led again</source>
            <translation type="unfinished">Vorführung: Ein aufgezeichneter Versuch wird noch einmal geführt</translation>
        </message>
        <message>
            <source>Demonstration: a scripted expert has the needle</source>
            <translation type="unfinished">Vorführung: Ein automatischer Experte hat die Nadel</translation>
        </message>
        <message>
            <source>Briefing of this exercise</source>
            <translation type="unfinished">Einweisung in diese Übung</translation>
        </message>
        <message>
            <source>Show me this exercise</source>
            <translation type="unfinished">Diese Übung vormachen</translation>
        </message>
        <message>
            <source>level {n} of {most}</source>
            <translation type="unfinished">Stufe {n} von {most}</translation>
        </message>
        <message>
            <source>Assessment</source>
            <translation type="unfinished">Prüfung</translation>
        </message>
        <message>
            <source>{name}: stay {mm:g} mm away</source>
            <translation type="unfinished">{name}: {mm:g} mm Abstand halten</translation>
        </message>
        <message>
            <source>{mark:g} of 100 points pass.</source>
            <translation type="unfinished">{mark:g} von 100 Punkten genügen zum Bestehen.</translation>
        </message>
        <message>
            <source>{title}: best from {best}, passes from {passes}</source>
            <translation type="unfinished">{title}: bestens ab {best}, bestanden ab {passes}</translation>
        </message>
        <message>
            <source>{title}: best up to {best}, passes up to {passes}</source>
            <translation type="unfinished">{title}: bestens bis {best}, bestanden bis {passes}</translation>
        </message>
        <message>
            <source>; must be kept</source>
            <translation type="unfinished">; muss eingehalten werden</translation>
        </message>
        <message>
            <source>{m}:{s:02d} min</source>
            <translation type="unfinished">{m}:{s:02d} min</translation>
        </message>
        <message>
            <source>the robot's help</source>
            <translation type="unfinished">die Hilfe des Roboters</translation>
        </message>
        <message>
            <source>what is shown</source>
            <translation type="unfinished">was gezeigt wird</translation>
        </message>
        <message>
            <source>window, slab and layout</source>
            <translation type="unfinished">Fensterung, Slab und Anordnung</translation>
        </message>
        <message>
            <source>what moves the hand</source>
            <translation type="unfinished">womit die Hand bewegt wird</translation>
        </message>
        <message>
            <source>the way effects are computed</source>
            <translation type="unfinished">wie Effekte berechnet werden</translation>
        </message>
        <message>
            <source>Nothing: you may change help, views and layout.</source>
            <translation type="unfinished">Nichts: Sie dürfen Hilfe, Ansichten und Anordnung ändern.</translation>
        </message>
        <message>
            <source>Stays as it is: {what}.</source>
            <translation type="unfinished">Bleibt, wie es ist: {what}.</translation>
        </message>
        <message>
            <source>The robot helps less from attempt to attempt.</source>
            <translation type="unfinished">Der Roboter hilft von Versuch zu Versuch weniger.</translation>
        </message>
        <message>
            <source>The robot helps less the better you do.</source>
            <translation type="unfinished">Der Roboter hilft umso weniger, je besser Sie sind.</translation>
        </message>
        <message>
            <source>Every {n}th attempt is without any help.</source>
            <translation type="unfinished">Ohne jede Hilfe: jeder {n}. Versuch.</translation>
        </message>
        <message>
            <source>The robot guides with {share:.0f} %.</source>
            <translation type="unfinished">Der Roboter führt mit {share:.0f} %.</translation>
        </message>
        <message>
            <source>The robot pushes off the path with {share:.0f} %.</source>
            <translation type="unfinished">Der Roboter drückt mit {share:.0f} % vom Pfad weg.</translation>
        </message>
        <message>
            <source>The robot does not help.</source>
            <translation type="unfinished">Der Roboter hilft nicht.</translation>
        </message>
        <message>
            <source>The hand moves the tool's handle: the tip goes the other way.</source>
            <translation type="unfinished">Die Hand bewegt den Griff des Instruments: Die Spitze geht in die Gegenrichtung.</translation>
        </message>
        <message>
            <source>The needle is seen on control scans alone (S): {n} slices of {mm:g} mm.</source>
            <translation type="unfinished">Die Nadel ist nur auf Kontrollscans zu sehen (S); Schichten: {n} zu {mm:g} mm.</translation>
        </message>
        <message>
            <source>Shown: {views}.</source>
            <translation type="unfinished">Gezeigt: {views}.</translation>
        </message>
        <message>
            <source>Any number of attempts.</source>
            <translation type="unfinished">Beliebig viele Versuche.</translation>
        </message>
        <message>
            <source>{n} attempts are allowed.</source>
            <translation type="unfinished">{n} Versuche sind erlaubt.</translation>
        </message>
        <message>
            <source>1 attempt is allowed.</source>
            <translation type="unfinished">1 Versuch ist erlaubt.</translation>
        </message>
        <message>
            <source>{left} of {n} attempts are left.</source>
            <translation type="unfinished">Verbleibende Versuche: {left} von {n}.</translation>
        </message>
        <message>
            <source>The one attempt is left.</source>
            <translation type="unfinished">Der eine Versuch ist noch frei.</translation>
        </message>
        <message>
            <source>The one attempt is used.</source>
            <translation type="unfinished">Der eine Versuch ist verbraucht.</translation>
        </message>
        <message>
            <source>Course: {title}.</source>
            <translation type="unfinished">Kurs: {title}.</translation>
        </message>
        <message>
            <source>Not now: {why}.</source>
            <translation type="unfinished">Jetzt nicht: {why}.</translation>
        </message>
        <message>
            <source>Axial</source>
            <translation type="unfinished">Axial</translation>
        </message>
        <message>
            <source>Coronal</source>
            <translation type="unfinished">Koronar</translation>
        </message>
        <message>
            <source>Sagittal</source>
            <translation type="unfinished">Sagittal</translation>
        </message>
        <message>
            <source>being made</source>
            <translation type="unfinished">in Arbeit</translation>
        </message>
        <message>
            <source>with the plan</source>
            <translation type="unfinished">mit dem Plan</translation>
        </message>
        <message>
            <source>The picture is being made …</source>
            <translation type="unfinished">Das Bild entsteht …</translation>
        </message>
        <message>
            <source>Begin (Enter)</source>
            <translation type="unfinished">Beginnen (Eingabe)</translation>
        </message>
        <message>
            <source>Show me (D)</source>
            <translation type="unfinished">Vormachen (D)</translation>
        </message>
        <message>
            <source>Look around first (L)</source>
            <translation type="unfinished">Erst umsehen (L)</translation>
        </message>
        <message>
            <source>Back (Esc)</source>
            <translation type="unfinished">Zurück (Esc)</translation>
        </message>
        <message>
            <source>Do not show this again for this exercise</source>
            <translation type="unfinished">Bei dieser Übung nicht mehr zeigen</translation>
        </message>
        <message>
            <source>The attempt starts as soon as robot and cameras are there</source>
            <translation type="unfinished">Der Versuch beginnt, sobald Roboter und Kameras bereit sind</translation>
        </message>
        <message>
            <source>An expert does the exercise; nothing is recorded</source>
            <translation type="unfinished">Ein Experte macht die Übung; nichts wird aufgezeichnet</translation>
        </message>
        <message>
            <source>Study the CT without the clock; F5 starts the attempt</source>
            <translation type="unfinished">Das CT ohne Zeitdruck studieren; F5 startet den Versuch</translation>
        </message>
        <message>
            <source>Insert the needle to the target.</source>
            <translation type="unfinished">Führen Sie die Nadel bis zum Ziel ein.</translation>
        </message>
        <message>
            <source>Begin to plan (Enter)</source>
            <translation type="unfinished">Planung beginnen (Eingabe)</translation>
        </message>
        <message>
            <source>You choose the entry here, so there is nothing to show before you have.</source>
            <translation type="unfinished">Sie wählen hier den Einstichpunkt selbst; vorher gibt es nichts zu zeigen.</translation>
        </message>
        <message>
            <source>What is scored</source>
            <translation type="unfinished">Was bewertet wird</translation>
        </message>
        <message>
            <source>What helps</source>
            <translation type="unfinished">Was hilft</translation>
        </message>
        <message>
            <source>What is locked</source>
            <translation type="unfinished">Was gesperrt ist</translation>
        </message>
        <message>
            <source>Attempts</source>
            <translation type="unfinished">Versuche</translation>
        </message>
        <message>
            <source>Depth bar</source>
            <translation type="unfinished">Tiefenbalken</translation>
        </message>
        <message>
            <source>Target {mm:.0f}</source>
            <translation type="unfinished">Ziel {mm:.0f}</translation>
        </message>
        <message>
            <source>Skin 0 · Target {target:.0f} · Stop {stop:.0f} mm</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Skin</source>
            <translation type="unfinished">Haut</translation>
        </message>
        <message>
            <source>Stop {mm:.0f}</source>
            <translation type="unfinished">Stopp {mm:.0f}</translation>
        </message>
        <message>
            <source>patient left</source>
            <translation type="unfinished">Patient links</translation>
        </message>
        <message>
            <source>patient right</source>
            <translation type="unfinished">Patient rechts</translation>
        </message>
        <message>
            <source>front</source>
            <translation type="unfinished">vorn</translation>
        </message>
        <message>
            <source>back</source>
            <translation type="unfinished">hinten</translation>
        </message>
        <message>
            <source>head</source>
            <translation type="unfinished">Kopf</translation>
        </message>
        <message>
            <source>feet</source>
            <translation type="unfinished">Füße</translation>
        </message>
        <message>
            <source>In plane</source>
            <translation type="unfinished">In der Ebene</translation>
        </message>
        <message>
            <source>Out of plane</source>
            <translation type="unfinished">Aus der Ebene</translation>
        </message>
        <message>
            <source>Sideways</source>
            <translation type="unfinished">Seitlich</translation>
        </message>
        <message>
            <source>Up / down</source>
            <translation type="unfinished">Auf / ab</translation>
        </message>
        <message>
            <source>{name}: ✔ on path</source>
            <translation type="unfinished">{name}: ✔ auf dem Pfad</translation>
        </message>
        <message>
            <source>{name}: {angle:.1f}° to {to}</source>
            <translation type="unfinished">{name}: {angle:.1f}° nach {to}</translation>
        </message>
        <message>
            <source>{name}: tilt the hub {angle:.1f}° towards {where}</source>
            <translation type="unfinished">{name}: Ansatz {angle:.1f}° neigen, Richtung {where}</translation>
        </message>
        <message>
            <source>{name}: tilt the tip {angle:.1f}° towards {where}</source>
            <translation type="unfinished">{name}: Spitze {angle:.1f}° neigen, Richtung {where}</translation>
        </message>
        <message>
            <source>{length:.1f} mm off path</source>
            <translation type="unfinished">{length:.1f} mm seitlich</translation>
        </message>
        <message>
            <source>off the path: {length:.1f} mm</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>The dot is where the needle will pass the target: bring it into the middle. Rings: how far off, the inner two are the tolerance</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{mm} mm off</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>▼ {mm} mm</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>▲ {mm} mm</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>✔ hold</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>CT angles: in plane {a} (path {b})
out of plane {c:+.1f}° (path {d:+.1f}°)</source>
            <translation type="unfinished">CT-Winkel: in der Ebene {a} (Pfad {b})
aus der Ebene {c:+.1f}° (Pfad {d:+.1f}°)</translation>
        </message>
        <message>
            <source>✔ at target: hold ({gap:+.1f} mm)</source>
            <translation type="unfinished">✔ am Ziel: halten ({gap:+.1f} mm)</translation>
        </message>
        <message>
            <source>beside the target</source>
            <translation type="unfinished">neben dem Ziel</translation>
        </message>
        <message>
            <source>▼ push {gap:.1f} mm</source>
            <translation type="unfinished">▼ {gap:.1f} mm vorschieben</translation>
        </message>
        <message>
            <source>▲ too deep: pull {gap:.1f} mm</source>
            <translation type="unfinished">▲ zu tief: {gap:.1f} mm zurückziehen</translation>
        </message>
        <message>
            <source>Legend</source>
            <translation type="unfinished">Legende</translation>
        </message>
        <message>
            <source>Legend, shown or hidden</source>
            <translation type="unfinished">Legende ein- oder ausblenden</translation>
        </message>
        <message>
            <source>◇ depth not measured now</source>
            <translation type="unfinished">◇ Tiefe jetzt nicht gemessen</translation>
        </message>
        <message>
            <source>◇ not measured</source>
            <translation type="unfinished">◇ nicht gemessen</translation>
        </message>
        <message>
            <source>Camera picture</source>
            <translation type="unfinished">Kamerabild</translation>
        </message>
        <message>
            <source>No picture</source>
            <translation type="unfinished">Kein Bild</translation>
        </message>
        <message>
            <source>marker not seen</source>
            <translation type="unfinished">Marker nicht zu sehen</translation>
        </message>
        <message>
            <source>{name}: {why}</source>
            <translation type="unfinished">{name}: {why}</translation>
        </message>
        <message>
            <source>left camera</source>
            <translation type="unfinished">linke Kamera</translation>
        </message>
        <message>
            <source>right camera</source>
            <translation type="unfinished">rechte Kamera</translation>
        </message>
        <message>
            <source>another patient was opened</source>
            <translation type="unfinished">ein anderer Patient wurde geöffnet</translation>
        </message>
        <message>
            <source>The hand holds the tool's handle: the tip goes the other way.</source>
            <translation type="unfinished">Die Hand hält den Griff des Instruments: Die Spitze geht in die Gegenrichtung.</translation>
        </message>
        <message>
            <source>Choose an exercise first.</source>
            <translation type="unfinished">Wählen Sie zuerst eine Übung.</translation>
        </message>
        <message>
            <source>Control scans guide here: nothing shows the needle between them.</source>
            <translation type="unfinished">Hier führen Kontrollscans: Dazwischen zeigt nichts die Nadel.</translation>
        </message>
        <message>
            <source>Views can be switched between attempts.</source>
            <translation type="unfinished">Ansichten lassen sich zwischen den Versuchen wechseln.</translation>
        </message>
        <message>
            <source>This assessment is made for another CT than the one that is open: begin it from the start page, which opens its own.</source>
            <translation type="unfinished">Diese Prüfung ist für ein anderes CT als das offene gemacht: Beginnen Sie sie auf der Startseite, die öffnet ihr eigenes.</translation>
        </message>
        <message>
            <source>The CT in {folder} is not the one the exercise was made on, or was read differently: put the right one there, or make the exercise again on this one.</source>
            <translation type="unfinished">Das CT in {folder} ist nicht das, mit dem die Übung gemacht wurde, oder es wurde anders gelesen: Legen Sie das richtige dorthin oder machen Sie die Übung mit diesem neu.</translation>
        </message>
        <message>
            <source>The needle is not there yet.</source>
            <translation type="unfinished">Die Nadel ist noch nicht da.</translation>
        </message>
        <message>
            <source>✖ robot not ready</source>
            <translation type="unfinished">✖ Roboter nicht bereit</translation>
        </message>
        <message>
            <source>why, and what to do: Robot's health (F8)</source>
            <translation type="unfinished">warum und was zu tun ist: Zustand des Roboters (F8)</translation>
        </message>
        <message>
            <source>– forces off</source>
            <translation type="unfinished">– Kräfte aus</translation>
        </message>
        <message>
            <source>start the attempt first</source>
            <translation type="unfinished">starten Sie zuerst den Versuch</translation>
        </message>
        <message>
            <source>let go of {key}</source>
            <translation type="unfinished">{key} loslassen</translation>
        </message>
        <message>
            <source>hold {key} again</source>
            <translation type="unfinished">{key} noch einmal halten</translation>
        </message>
        <message>
            <source>✖ no force: {todo}</source>
            <translation type="unfinished">✖ keine Kraft: {todo}</translation>
        </message>
        <message>
            <source>○ forces off</source>
            <translation type="unfinished">○ Kräfte aus</translation>
        </message>
        <message>
            <source>◐ switching on {percent:.0f} %</source>
            <translation type="unfinished">◐ wird eingeschaltet {percent:.0f} %</translation>
        </message>
        <message>
            <source>keep holding {key}</source>
            <translation type="unfinished">{key} weiter halten</translation>
        </message>
        <message>
            <source>● FORCES ON</source>
            <translation type="unfinished">● KRÄFTE EIN</translation>
        </message>
        <message>
            <source>let go of {key}: forces off</source>
            <translation type="unfinished">{key} loslassen: Kräfte aus</translation>
        </message>
        <message>
            <source>hold {key}, pedal or this button to switch on</source>
            <translation type="unfinished">{key}, Pedal oder diesen Knopf halten, um einzuschalten</translation>
        </message>
        <message>
            <source>The robot gives force only while {key}, a pedal or this button is held; the force rises within a second and is gone when you let go, or when the window loses the keyboard. After a fault let go and hold again.</source>
            <translation type="unfinished">Der Roboter gibt nur Kraft, solange {key}, ein Pedal oder dieser Knopf gehalten wird; die Kraft steigt innerhalb einer Sekunde an und ist weg, wenn Sie loslassen oder wenn das Fenster die Tastatur verliert. Nach einer Störung loslassen und wieder halten.</translation>
        </message>
        <message>
            <source>{joules:.3g} J</source>
            <translation type="unfinished">{joules:.3g} J</translation>
        </message>
        <message>
            <source>{value:.1f} mJ</source>
            <translation type="unfinished">{value:.1f} mJ</translation>
        </message>
        <message>
            <source>{v:.0f} mJ</source>
            <translation type="unfinished">{v:.0f} mJ</translation>
        </message>
        <message>
            <source>no energy account</source>
            <translation type="unfinished">keine Energiebilanz</translation>
        </message>
        <message>
            <source>force at {share:.0f} %</source>
            <translation type="unfinished">Kraft auf {share:.0f} %</translation>
        </message>
        <message>
            <source>damping added</source>
            <translation type="unfinished">zusätzliche Dämpfung</translation>
        </message>
        <message>
            <source>guard acts: {what}</source>
            <translation type="unfinished">Wächter greift ein: {what}</translation>
        </message>
        <message>
            <source>tank nearly empty</source>
            <translation type="unfinished">Vorrat fast leer</translation>
        </message>
        <message>
            <source>guard at rest</source>
            <translation type="unfinished">Wächter in Ruhe</translation>
        </message>
        <message>
            <source>Energy of the robot's force. Filled: what the force laws store now, as springs do. Line: what may still be let out to the hand, of the most they have declared. When it runs out, the guard weakens or damps the force, so that the robot cannot run away; that is no fault. If it acts often, lower the assistance, or look at the loop's lateness.</source>
            <translation type="unfinished">Energie der Roboterkraft. Gefüllt: was die Kraftgesetze jetzt speichern, wie Federn. Linie: was noch an die Hand abgegeben werden darf, vom Höchsten, das sie angegeben haben. Geht es zur Neige, schwächt oder dämpft der Wächter die Kraft, damit der Roboter nicht durchgehen kann; das ist keine Störung. Greift er oft ein, verringern Sie die Unterstützung oder sehen Sie nach der Verspätung der Regelschleife.</translation>
        </message>
        <message>
            <source>Energy</source>
            <translation type="unfinished">Energie</translation>
        </message>
        <message>
            <source>stored –</source>
            <translation type="unfinished">gespeichert –</translation>
        </message>
        <message>
            <source>left –</source>
            <translation type="unfinished">übrig –</translation>
        </message>
        <message>
            <source>removed by the guard –</source>
            <translation type="unfinished">vom Wächter entnommen –</translation>
        </message>
        <message>
            <source>stored {energy}</source>
            <translation type="unfinished">gespeichert {energy}</translation>
        </message>
        <message>
            <source>left {tank} of {bound}</source>
            <translation type="unfinished">übrig {tank} von {bound}</translation>
        </message>
        <message>
            <source>removed {energy}</source>
            <translation type="unfinished">entnommen {energy}</translation>
        </message>
        <message>
            <source>Energy of the force</source>
            <translation type="unfinished">Energie der Kraft</translation>
        </message>
        <message>
            <source>An attempt is running: end it first, then change {what}.</source>
            <translation type="unfinished">Ein Versuch läuft: Beenden Sie ihn zuerst und wechseln Sie dann {what}.</translation>
        </message>
        <message>
            <source>the robot</source>
            <translation type="unfinished">den Roboter</translation>
        </message>
        <message>
            <source>Go on with the attempt</source>
            <translation type="unfinished">Versuch fortsetzen</translation>
        </message>
        <message>
            <source>End it and quit</source>
            <translation type="unfinished">Beenden und schließen</translation>
        </message>
        <message>
            <source>Quit</source>
            <translation type="unfinished">Beenden</translation>
        </message>
        <message>
            <source>An attempt is running. End it and quit?</source>
            <translation type="unfinished">Ein Versuch läuft. Beenden und Programm schließen?</translation>
        </message>
        <message>
            <source>It ends without a score; what is recorded so far stays.</source>
            <translation type="unfinished">Er endet ohne Bewertung; was bisher aufgezeichnet ist, bleibt.</translation>
        </message>
        <message>
            <source>Start has to wait: earlier attempts are being looked up.</source>
            <translation type="unfinished">Der Start muss warten: Frühere Versuche werden nachgesehen.</translation>
        </message>
        <message>
            <source>This attempt is a probe: without help, as in an assessment.</source>
            <translation type="unfinished">Dieser Versuch ist ein Testversuch: ohne Hilfe, wie in einer Prüfung.</translation>
        </message>
        <message>
            <source>Assistance of this attempt: {share} %</source>
            <translation type="unfinished">Unterstützung dieses Versuchs: {share} %</translation>
        </message>
        <message>
            <source>{title} (not kept)</source>
            <translation type="unfinished">{title} (nicht gespeichert)</translation>
        </message>
        <message>
            <source>There is no exercise {name}; there are: {names}</source>
            <translation type="unfinished">Eine Übung {name} gibt es nicht; es gibt: {names}</translation>
        </message>
        <message>
            <source>An attempt is running: end it before another exercise is chosen</source>
            <translation type="unfinished">Ein Versuch läuft: Beenden Sie ihn, bevor Sie eine andere Übung wählen</translation>
        </message>
        <message>
            <source>Same plan, or a new one?</source>
            <translation type="unfinished">Derselbe Plan oder ein neuer?</translation>
        </message>
        <message>
            <source>The plan of an attempt stays in its record.</source>
            <translation type="unfinished">Der Plan eines Versuchs bleibt in seiner Aufzeichnung.</translation>
        </message>
        <message>
            <source>Same plan</source>
            <translation type="unfinished">Selber Plan</translation>
        </message>
        <message>
            <source>New plan</source>
            <translation type="unfinished">Neuer Plan</translation>
        </message>
        <message>
            <source>guidance limited to {n:.1f} N here</source>
            <translation type="unfinished">Führung hier auf {n:.1f} N begrenzt</translation>
        </message>
        <message>
            <source>the needle sticks out far, and the motors cannot push harder at so long a lever</source>
            <translation type="unfinished">die Nadel ragt weit heraus, und an so einem langen Hebel können die Motoren nicht stärker drücken</translation>
        </message>
        <message>
            <source>the depth is not measured; the robot keeps within its limits for every depth, and where the needle sticks out furthest no more than this reaches your hand</source>
            <translation type="unfinished">die Tiefe ist nicht gemessen; der Roboter hält seine Grenzen für jede Tiefe ein, und wo die Nadel am weitesten herausragt, erreicht nicht mehr als das Ihre Hand</translation>
        </message>
        <message>
            <source>the depth is known only to ± {mm:.0f} mm, and the force stays within its limit for all of that</source>
            <translation type="unfinished">die Tiefe ist nur auf ± {mm:.0f} mm bekannt, und die Kraft bleibt für diesen ganzen Bereich in ihrer Grenze</translation>
        </message>
        <message>
            <source>the lever is light here: a stronger push could not be stopped in time if you let go</source>
            <translation type="unfinished">der Hebel ist hier leicht: Ein stärkerer Druck ließe sich nicht rechtzeitig stoppen, wenn Sie losließen</translation>
        </message>
        <message>
            <source>at most {force:.1f} N</source>
            <translation type="unfinished">höchstens {force:.1f} N</translation>
        </message>
        <message>
            <source>{force:.1f} N {origin}</source>
            <translation type="unfinished">{force:.1f} N {origin}</translation>
        </message>
        <message>
            <source>measured</source>
            <translation type="unfinished">gemessen</translation>
        </message>
        <message>
            <source>estimated</source>
            <translation type="unfinished">geschätzt</translation>
        </message>
        <message>
            <source>The depth is not measured, and the force at the hand depends on it: this is the largest that it can be, estimated from the motor torques; what you feel may be less.</source>
            <translation type="unfinished">Die Tiefe ist nicht gemessen, und die Kraft an der Hand hängt davon ab: Dies ist die größte, die sie sein kann, geschätzt aus den Motordrehmomenten; was Sie spüren, kann weniger sein.</translation>
        </message>
        <message>
            <source>Force at the hand, measured by the robot's own gauge, across the needle.</source>
            <translation type="unfinished">Kraft an der Hand, quer zur Nadel, gemessen mit dem eigenen Kraftmesser des Roboters.</translation>
        </message>
        <message>
            <source>Force at the hand, estimated from the motor torques that are sent: no force sensor says what really arrives.</source>
            <translation type="unfinished">Kraft an der Hand, geschätzt aus den gesendeten Motordrehmomenten: Kein Kraftsensor sagt, was wirklich ankommt.</translation>
        </message>
        <message>
            <source>mouse, keys</source>
            <translation type="unfinished">Maus, Tasten</translation>
        </message>
        <message>
            <source>pen tablet</source>
            <translation type="unfinished">Grafiktablett</translation>
        </message>
        <message>
            <source>Drag or arrows: move the handle, and the tip goes the other way  ·  wheel away from you, Page Down, right button: push; hold: go on  ·  Shift: finer</source>
            <translation type="unfinished">Ziehen oder Pfeile: Griff bewegen, die Spitze geht in die Gegenrichtung  ·  Rad von Ihnen weg, Bild ab, rechte Taste: vorschieben; halten: weiter  ·  Umschalt: feiner</translation>
        </message>
        <message>
            <source>Drag or arrows: tilt  ·  wheel away from you, Page Down, right button: push; hold: go on  ·  Shift: finer  ·  Home: hand to needle</source>
            <translation type="unfinished">Ziehen oder Pfeile: neigen  ·  Rad von Ihnen weg, Bild ab, rechte Taste: vorschieben; halten: weiter  ·  Umschalt: feiner  ·  Pos1: Hand zur Nadel</translation>
        </message>
        <message>
            <source>Hold the pen like the needle, its point on the pad: lean it to tilt  ·  press: push in, with the side button: pull  ·  wheel or Page keys: 1 mm</source>
            <translation type="unfinished">Halten Sie den Stift wie die Nadel, die Spitze auf dem Feld: kippen, um zu neigen  ·  drücken: vorschieben, mit der Seitentaste: zurückziehen  ·  Rad oder Bildtasten: 1 mm</translation>
        </message>
        <message>
            <source>Left stick: tilt  ·  right stick away from you: push in, towards you: pull  ·  A: hand to needle</source>
            <translation type="unfinished">Linker Stick: neigen  ·  rechter Stick von Ihnen weg: vorschieben, zu Ihnen: zurückziehen  ·  A: Hand zur Nadel</translation>
        </message>
        <message>
            <source>You hold the needle. The simulated cameras cannot see how deep it is: say it by wheel or Page keys, 1 mm  ·  Shift: finer</source>
            <translation type="unfinished">Sie halten die Nadel. Die simulierten Kameras sehen nicht, wie tief sie ist: Geben Sie es mit Rad oder Bildtasten an, 1 mm  ·  Umschalt: feiner</translation>
        </message>
        <message>
            <source>Which end goes where mouse, keys or stick go, as the bull's-eye shows it. The tip: to the right is to the right. The hub: as the real needle turns about the skin, hub to the right brings the tip to the left.</source>
            <translation type="unfinished">Welches Ende dorthin geht, wohin Maus, Tasten oder Stick gehen, wie die Zielscheibe zeigt. Die Spitze: Nach rechts ist nach rechts. Der Ansatz: Die echte Nadel dreht sich um die Haut, der Ansatz nach rechts bringt die Spitze nach links.</translation>
        </message>
        <message>
            <source>moves the tip</source>
            <translation type="unfinished">bewegt die Spitze</translation>
        </message>
        <message>
            <source>moves the hub</source>
            <translation type="unfinished">bewegt den Ansatz</translation>
        </message>
        <message>
            <source>The hand moves</source>
            <translation type="unfinished">Die Hand bewegt</translation>
        </message>
        <message>
            <source>How far the hand moves when mouse, pen or stick moves</source>
            <translation type="unfinished">Wie weit die Hand geht, wenn Maus, Stift oder Stick sich bewegt</translation>
        </message>
        <message>
            <source>fine</source>
            <translation type="unfinished">fein</translation>
        </message>
        <message>
            <source>normal</source>
            <translation type="unfinished">normal</translation>
        </message>
        <message>
            <source>direct</source>
            <translation type="unfinished">direkt</translation>
        </message>
        <message>
            <source>▼ push</source>
            <translation type="unfinished">▼ vorschieben</translation>
        </message>
        <message>
            <source>▲ pull</source>
            <translation type="unfinished">▲ zurückziehen</translation>
        </message>
        <message>
            <source>Hold to push the needle in. So do: wheel away from you, Page Down, right button</source>
            <translation type="unfinished">Halten, um die Nadel vorzuschieben. Ebenso: Rad von Ihnen weg, Bild ab, rechte Taste</translation>
        </message>
        <message>
            <source>Hold to pull the needle. So do: wheel towards you, Page Up, middle button</source>
            <translation type="unfinished">Halten, um die Nadel zurückzuziehen. Ebenso: Rad zu Ihnen, Bild auf, mittlere Taste</translation>
        </message>
        <message>
            <source>no gamepad: plug one in</source>
            <translation type="unfinished">kein Gamepad: schließen Sie eines an</translation>
        </message>
        <message>
            <source>waiting for the pen over the pad</source>
            <translation type="unfinished">wartet auf den Stift über dem Feld</translation>
        </message>
        <message>
            <source>this pen reports no tilt: move it instead</source>
            <translation type="unfinished">dieser Stift meldet keine Neigung: bewegen Sie ihn stattdessen</translation>
        </message>
        <message>
            <source>Bull's-eye pad</source>
            <translation type="unfinished">Feld der Zielscheibe</translation>
        </message>
        <message>
            <source>No planned path</source>
            <translation type="unfinished">Kein geplanter Pfad</translation>
        </message>
        <message>
            <source>Move the hand here: it is not shown</source>
            <translation type="unfinished">Bewegen Sie hier die Hand: Die Nadel wird nicht gezeigt</translation>
        </message>
        <message>
            <source>Rings: {sizes}</source>
            <translation type="unfinished">Ringe: {sizes}</translation>
        </message>
        <message>
            <source>Start attempt</source>
            <translation type="unfinished">Versuch starten</translation>
        </message>
        <message>
            <source>Control scan (S)</source>
            <translation type="unfinished">Kontrollscan (S)</translation>
        </message>
        <message>
            <source>End attempt (Enter)</source>
            <translation type="unfinished">Versuch beenden (Eingabe)</translation>
        </message>
        <message>
            <source>The needle stays as it is and is scored</source>
            <translation type="unfinished">Die Nadel bleibt, wie sie ist, und wird bewertet</translation>
        </message>
        <message>
            <source>Abort (hold Esc)</source>
            <translation type="unfinished">Abbrechen (Esc halten)</translation>
        </message>
        <message>
            <source>Set the force to zero at once; the attempt is saved but not scored</source>
            <translation type="unfinished">Setzt die Kraft sofort auf null; der Versuch wird gespeichert, aber nicht bewertet</translation>
        </message>
        <message>
            <source>Arm the robot and begin recording (F5)</source>
            <translation type="unfinished">Roboter scharf schalten und Aufzeichnung beginnen (F5)</translation>
        </message>
        <message>
            <source>Counts a scan and keeps the needle's place with it</source>
            <translation type="unfinished">Zählt einen Scan und merkt sich dazu die Lage der Nadel</translation>
        </message>
        <message>
            <source>The pedal: takes the slices that are set below, with the needle where it is now</source>
            <translation type="unfinished">Das Pedal: nimmt die unten eingestellten Schichten auf, mit der Nadel, wo sie jetzt ist</translation>
        </message>
        <message>
            <source>The needle is out</source>
            <translation type="unfinished">Die Nadel ist draußen</translation>
        </message>
        <message>
            <source>Recorded as your word, not as measured; a depth inside the skin refutes it</source>
            <translation type="unfinished">Wird als Ihre Angabe aufgezeichnet, nicht als gemessen; eine Tiefe unter der Haut widerlegt sie</translation>
        </message>
        <message>
            <source>Bevel turned by {angle:.0f}°</source>
            <translation type="unfinished">Schliff um {angle:.0f}° gedreht</translation>
        </message>
        <message>
            <source>{n} of {of} touched</source>
            <translation type="unfinished">{n} von {of} berührt</translation>
        </message>
        <message>
            <source>{mm:.0f} mm to target {n}</source>
            <translation type="unfinished">noch {mm:.0f} mm bis Ziel {n}</translation>
        </message>
        <message>
            <source>the tip is not through the trocar yet: push</source>
            <translation type="unfinished">die Spitze ist noch nicht durch den Trokar: vorschieben</translation>
        </message>
        <message>
            <source>1 mm of hand moves the tip {mm:.1f} mm, the other way</source>
            <translation type="unfinished">1 mm der Hand bewegt die Spitze {mm:.1f} mm in die Gegenrichtung</translation>
        </message>
        <message>
            <source>Breathe in, breathe out, hold: until you let him breathe</source>
            <translation type="unfinished">Einatmen, ausatmen, Luft anhalten: bis Sie ihn wieder atmen lassen</translation>
        </message>
        <message>
            <source>Hold the breath (A)</source>
            <translation type="unfinished">Atem anhalten (A)</translation>
        </message>
        <message>
            <source>Let breathe (A)</source>
            <translation type="unfinished">Atmen lassen (A)</translation>
        </message>
        <message>
            <source>holds: {s:.0f} s left</source>
            <translation type="unfinished">hält an: noch {s:.0f} s</translation>
        </message>
        <message>
            <source>breathes by himself</source>
            <translation type="unfinished">atmet von selbst</translation>
        </message>
        <message>
            <source>Release (A)</source>
            <translation type="unfinished">Loslassen (A)</translation>
        </message>
        <message>
            <source>breathes out and holds</source>
            <translation type="unfinished">atmet aus und hält an</translation>
        </message>
        <message>
            <source>breathes</source>
            <translation type="unfinished">atmet</translation>
        </message>
        <message>
            <source>Assistance
fixed</source>
            <translation type="unfinished">Unterstützung
fest</translation>
        </message>
        <message>
            <source>Assistance
free to turn</source>
            <translation type="unfinished">Unterstützung
frei wählbar</translation>
        </message>
        <message>
            <source>Practice: you may turn the dial. Every attempt begins with the exercise's own.</source>
            <translation type="unfinished">Training: Sie dürfen den Regler drehen. Jeder Versuch beginnt mit dem Wert der Übung.</translation>
        </message>
        <message>
            <source>Robot and cameras are being started: an attempt can begin in a moment.</source>
            <translation type="unfinished">Roboter und Kameras werden gestartet: Gleich kann ein Versuch beginnen.</translation>
        </message>
        <message>
            <source>anonymous (instructor signed in)</source>
            <translation type="unfinished">anonym (Kursleiter angemeldet)</translation>
        </message>
        <message>
            <source>anonymous</source>
            <translation type="unfinished">anonym</translation>
        </message>
        <message>
            <source>A pseudonym, never a name: it goes into every record. Letters, digits, . _ -</source>
            <translation type="unfinished">Ein Pseudonym, nie ein Name: Es kommt in jede Aufzeichnung. Buchstaben, Ziffern, . _ -</translation>
        </message>
        <message>
            <source>no cameras</source>
            <translation type="unfinished">keine Kameras</translation>
        </message>
        <message>
            <source>marker out of view (both cameras)</source>
            <translation type="unfinished">Marker außer Sicht (beide Kameras)</translation>
        </message>
        <message>
            <source>marker still in the tube</source>
            <translation type="unfinished">Marker noch im Rohr</translation>
        </message>
        <message>
            <source>a picture is late</source>
            <translation type="unfinished">ein Bild ist verspätet</translation>
        </message>
        <message>
            <source>marker out of view ({cameras})</source>
            <translation type="unfinished">Marker außer Sicht ({cameras})</translation>
        </message>
        <message>
            <source>the cameras disagree</source>
            <translation type="unfinished">die Kameras widersprechen sich</translation>
        </message>
        <message>
            <source>fault {code}: no force</source>
            <translation type="unfinished">Störung {code}: keine Kraft</translation>
        </message>
        <message>
            <source>The line is the largest force the device may give now.</source>
            <translation type="unfinished">Die Linie ist die größte Kraft, die das Gerät jetzt geben darf.</translation>
        </message>
        <message>
            <source>{limit}: {reason}</source>
            <translation type="unfinished">{limit}: {reason}</translation>
        </message>
        <message>
            <source>limit {limit:g} N</source>
            <translation type="unfinished">Grenze {limit:g} N</translation>
        </message>
        <message>
            <source>Force felt</source>
            <translation type="unfinished">Gefühlte Kraft</translation>
        </message>
        <message>
            <source>Since the start of the attempt</source>
            <translation type="unfinished">Seit Beginn des Versuchs</translation>
        </message>
        <message>
            <source>Depth</source>
            <translation type="unfinished">Tiefe</translation>
        </message>
        <message>
            <source>Tip beyond the entry, along the needle; ◇ when it is not measured now</source>
            <translation type="unfinished">Spitze hinter dem Einstichpunkt, entlang der Nadel; ◇, wenn jetzt nicht gemessen</translation>
        </message>
        <message>
            <source>Angle error</source>
            <translation type="unfinished">Winkelfehler</translation>
        </message>
        <message>
            <source>Between the needle and the planned path</source>
            <translation type="unfinished">Zwischen der Nadel und dem geplanten Pfad</translation>
        </message>
        <message>
            <source>Off the path</source>
            <translation type="unfinished">Seitlicher Fehler</translation>
        </message>
        <message>
            <source>Tip from the line of the planned path</source>
            <translation type="unfinished">Abstand der Spitze von der Linie des geplanten Pfads</translation>
        </message>
        <message>
            <source>To target</source>
            <translation type="unfinished">Bis zum Ziel</translation>
        </message>
        <message>
            <source>Along the path; negative when the tip is too deep</source>
            <translation type="unfinished">Entlang des Pfads; negativ, wenn die Spitze zu tief ist</translation>
        </message>
        <message>
            <source>Tip known to</source>
            <translation type="unfinished">Spitze bekannt auf</translation>
        </message>
        <message>
            <source>Radius round the tip that holds the true one with 95 %, as it is shown now</source>
            <translation type="unfinished">Radius um die gezeigte Spitze, in dem die wahre mit 95 % liegt</translation>
        </message>
        <message>
            <source>Bending</source>
            <translation type="unfinished">Biegung</translation>
        </message>
        <message>
            <source>Tip off the straight needle, by tissue or cameras; less than chance is shown as &lt;</source>
            <translation type="unfinished">Abstand der Spitze von der geraden Nadel, durch Gewebe oder Kameras; weniger als Zufall wird als &lt; gezeigt</translation>
        </message>
        <message>
            <source>Scans taken in this attempt</source>
            <translation type="unfinished">Scans in diesem Versuch</translation>
        </message>
        <message>
            <source>{mm:.1f} mm</source>
            <translation type="unfinished">{mm:.1f} mm</translation>
        </message>
        <message>
            <source>{deg:.1f}°</source>
            <translation type="unfinished">{deg:.1f}°</translation>
        </message>
        <message>
            <source>± {mm:.1f} mm</source>
            <translation type="unfinished">± {mm:.1f} mm</translation>
        </message>
        <message>
            <source>&lt; {mm:.1f} mm</source>
            <translation type="unfinished">&lt; {mm:.1f} mm</translation>
        </message>
        <message>
            <source>the window was closed</source>
            <translation type="unfinished">das Fenster wurde geschlossen</translation>
        </message>
        <message>
            <source>Starting robot and cameras</source>
            <translation type="unfinished">Roboter und Kameras werden gestartet</translation>
        </message>
        <message>
            <source>scanning…</source>
            <translation type="unfinished">Scan läuft…</translation>
        </message>
        <message>
            <source>{low} to {high}</source>
            <translation type="unfinished">{low} bis {high}</translation>
        </message>
        <message>
            <source>Scans: {n} · {dose:.1f} mGy·cm ({estimate})</source>
            <translation type="unfinished">Scans: {n} · {dose:.1f} mGy·cm ({estimate})</translation>
        </message>
        <message>
            <source>Middle of the scan along the patient (z of LPS): + is headwards</source>
            <translation type="unfinished">Mitte des Scans entlang des Patienten (z in LPS): + ist kopfwärts</translation>
        </message>
        <message>
            <source>Table position</source>
            <translation type="unfinished">Tischposition</translation>
        </message>
        <message>
            <source>One slice towards the feet</source>
            <translation type="unfinished">Eine Schicht zu den Füßen hin</translation>
        </message>
        <message>
            <source>One slice towards the head</source>
            <translation type="unfinished">Eine Schicht zum Kopf hin</translation>
        </message>
        <message>
            <source>At crosshair</source>
            <translation type="unfinished">Am Fadenkreuz</translation>
        </message>
        <message>
            <source>Move the table to the axial slice that is shown</source>
            <translation type="unfinished">Fährt den Tisch zur angezeigten axialen Schicht</translation>
        </message>
        <message>
            <source>Dose-length product as the exercise sets it: a teaching estimate, no dose of any scanner</source>
            <translation type="unfinished">Dosis-Längen-Produkt nach Vorgabe der Übung: ein Schätzwert für die Lehre, keine Dosis eines Scanners</translation>
        </message>
        <message>
            <source>Control scan</source>
            <translation type="unfinished">Kontrollscan</translation>
        </message>
        <message>
            <source>Table</source>
            <translation type="unfinished">Tisch</translation>
        </message>
        <message>
            <source>All slices</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>No control scan yet.
Set table and slices, then press the pedal (S).</source>
            <translation type="unfinished">Noch kein Kontrollscan.
Stellen Sie Tisch und Schichten ein und drücken Sie dann das Pedal (S).</translation>
        </message>
        <message>
            <source>Control scan {n} at {time:.0f} s · {slices} × {mm:g} mm · {dose:.1f} mGy·cm ({estimate})</source>
            <translation type="unfinished">Kontrollscan {n} bei {time:.0f} s · {slices} × {mm:g} mm · {dose:.1f} mGy·cm ({estimate})</translation>
        </message>
        <message>
            <source>Messages</source>
            <translation type="unfinished">Meldungen</translation>
        </message>
        <message>
            <source>Click: with details, or without</source>
            <translation type="unfinished">Klick: mit oder ohne Einzelheiten</translation>
        </message>
        <message>
            <source>Status</source>
            <translation type="unfinished">Status</translation>
        </message>
        <message>
            <source>{rate:.0f} Hz · late {median:.2f} / {p99:.2f} ms · {missing:.1f} % missed</source>
            <translation type="unfinished">{rate:.0f} Hz · verspätet {median:.2f} / {p99:.2f} ms · {missing:.1f} % verpasst</translation>
        </message>
        <message>
            <source>Robot loop</source>
            <translation type="unfinished">Regelschleife</translation>
        </message>
        <message>
            <source>Rate of the force loop, its lateness (median / 99th percentile) and the share of deadlines it missed in the last {seconds:.0f} s; since the start it missed {missed} of {ticks}. If it is late, close other programs; forces stay limited either way.</source>
            <translation type="unfinished">Rate der Regelschleife für die Kraft, ihre Verspätung (Median / 99. Perzentil) und der Anteil der Termine, die sie in den letzten {seconds:.0f} s verpasst hat; seit dem Start verpasste sie {missed} von {ticks}. Ist sie verspätet, schließen Sie andere Programme; die Kräfte bleiben so oder so begrenzt.</translation>
        </message>
        <message>
            <source>fault: no force</source>
            <translation type="unfinished">Störung: keine Kraft</translation>
        </message>
        <message>
            <source>Encoders</source>
            <translation type="unfinished">Encoder</translation>
        </message>
        <message>
            <source>Age of the robot's joint angles. The force fades from 20 ms and is zero from 100 ms. If it stays old, check the robot's cable and power, then start the attempt again.</source>
            <translation type="unfinished">Alter der Gelenkwinkel des Roboters. Ab 20 ms nimmt die Kraft ab, ab 100 ms ist sie null. Bleibt es hoch, prüfen Sie Kabel und Stromversorgung des Roboters und starten Sie den Versuch neu.</translation>
        </message>
        <message>
            <source>{rate:.0f} Hz · {share:.0f} % valid · {age}</source>
            <translation type="unfinished">{rate:.0f} Hz · {share:.0f} % gültig · {age}</translation>
        </message>
        <message>
            <source>Rate of the tracker, share of pictures in which both cameras saw the marker, age of the last such fix. If the marker is out of view, bring it back between the cameras; look at the camera pictures for dirt, light or something in the way.</source>
            <translation type="unfinished">Rate des Trackers, Anteil der Bilder, auf denen beide Kameras den Marker sahen, Alter der letzten solchen Messung. Ist der Marker außer Sicht, bringen Sie ihn wieder zwischen die Kameras; achten Sie in den Kamerabildern auf Schmutz, Licht oder etwas im Weg.</translation>
        </message>
        <message>
            <source>see the marker</source>
            <translation type="unfinished">sehen den Marker</translation>
        </message>
        <message>
            <source>from the cameras</source>
            <translation type="unfinished">von den Kameras</translation>
        </message>
        <message>
            <source>from one camera</source>
            <translation type="unfinished">von einer Kamera</translation>
        </message>
        <message>
            <source>held, {age} old</source>
            <translation type="unfinished">gehalten, {age} alt</translation>
        </message>
        <message>
            <source>unknown</source>
            <translation type="unfinished">unbekannt</translation>
        </message>
        <message>
            <source>The depth is measured by the cameras; by one of them and the needle's line, less exactly, while the other does not see the marker. Without a fix it is held for 200 ms. After that, and until ten pictures in a row agree, nobody knows it: the force is held back for the worst depth that the needle can have. Wait until the cameras see the marker again.</source>
            <translation type="unfinished">Die Tiefe wird von den Kameras gemessen; von einer und der Linie der Nadel weniger genau, solange die andere den Marker nicht sieht. Ohne Messung wird sie 200 ms lang gehalten. Danach, und bis zehn Bilder in Folge übereinstimmen, kennt sie niemand: Die Kraft wird für die ungünstigste Tiefe zurückgehalten, die die Nadel haben kann. Warten Sie, bis die Kameras den Marker wieder sehen.</translation>
        </message>
        <message>
            <source>Heartbeat</source>
            <translation type="unfinished">Lebenszeichen</translation>
        </message>
        <message>
            <source>The window's sign of life to the robot. After 1 s without one the force goes to zero. If it stops, the window is frozen: wait, or end the program.</source>
            <translation type="unfinished">Das Lebenszeichen des Fensters an den Roboter. Nach 1 s ohne eines geht die Kraft auf null. Bleibt es aus, ist das Fenster eingefroren: Warten Sie oder beenden Sie das Programm.</translation>
        </message>
        <message>
            <source>Robot ready</source>
            <translation type="unfinished">Roboter bereit</translation>
        </message>
        <message>
            <source>Robot held back: {why}</source>
            <translation type="unfinished">Roboter zurückgehalten: {why}</translation>
        </message>
        <message>
            <source>Robot stopped: {why}</source>
            <translation type="unfinished">Roboter angehalten: {why}</translation>
        </message>
        <message>
            <source>see the marker now and then</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>do not see the marker</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>There are no cameras here: the depth comes from elsewhere, or from nowhere.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>measured a moment ago</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>No robot</source>
            <translation type="unfinished">Kein Roboter</translation>
        </message>
        <message>
            <source>it does not answer</source>
            <translation type="unfinished">er antwortet nicht</translation>
        </message>
        <message>
            <source>this window stood still</source>
            <translation type="unfinished">dieses Fenster stand still</translation>
        </message>
        <message>
            <source>it calms the needle</source>
            <translation type="unfinished">er beruhigt die Nadel</translation>
        </message>
        <message>
            <source>it answers late</source>
            <translation type="unfinished">er antwortet spät</translation>
        </message>
        <message>
            <source>the depth is not certain</source>
            <translation type="unfinished">die Tiefe ist nicht sicher</translation>
        </message>
        <message>
            <source>Robot ready, the computer is busy</source>
            <translation type="unfinished">Roboter bereit, der Computer ist ausgelastet</translation>
        </message>
        <message>
            <source>acts: the force is weakened or damped</source>
            <translation type="unfinished">greift ein: Die Kraft wird geschwächt oder gedämpft</translation>
        </message>
        <message>
            <source>at rest</source>
            <translation type="unfinished">in Ruhe</translation>
        </message>
        <message>
            <source>Energy guard: {words}</source>
            <translation type="unfinished">Energiewächter: {words}</translation>
        </message>
        <message>
            <source>not recording</source>
            <translation type="unfinished">zeichnet nicht auf</translation>
        </message>
        <message>
            <source>recording</source>
            <translation type="unfinished">zeichnet auf</translation>
        </message>
        <message>
            <source>{lost} samples lost</source>
            <translation type="unfinished">Verlorene Messwerte: {lost}</translation>
        </message>
        <message>
            <source>failed</source>
            <translation type="unfinished">fehlgeschlagen</translation>
        </message>
        <message>
            <source>Recorder</source>
            <translation type="unfinished">Rekorder</translation>
        </message>
        <message>
            <source>Every attempt is written to disk, flushed each second. If samples are lost, the disk is too slow or full: free some space.</source>
            <translation type="unfinished">Jeder Versuch wird auf die Festplatte geschrieben, jede Sekunde gesichert. Gehen Messwerte verloren, ist die Platte zu langsam oder voll: Schaffen Sie Platz.</translation>
        </message>
        <message>
            <source>never</source>
            <translation type="unfinished">nie</translation>
        </message>
        <message>
            <source>{ms:.0f} ms</source>
            <translation type="unfinished">{ms:.0f} ms</translation>
        </message>
        <message>
            <source>{s:.1f} s</source>
            <translation type="unfinished">{s:.1f} s</translation>
        </message>
        <message>
            <source>Ready</source>
            <translation type="unfinished">Bereit</translation>
        </message>
        <message>
            <source>Withdrawing</source>
            <translation type="unfinished">Herausziehen</translation>
        </message>
        <message>
            <source>Aligning</source>
            <translation type="unfinished">Ausrichten</translation>
        </message>
        <message>
            <source>Inserting</source>
            <translation type="unfinished">Punktion</translation>
        </message>
        <message>
            <source>Holding</source>
            <translation type="unfinished">Halten</translation>
        </message>
        <message>
            <source>Paused</source>
            <translation type="unfinished">Pause</translation>
        </message>
        <message>
            <source>Ended</source>
            <translation type="unfinished">Beendet</translation>
        </message>
        <message>
            <source>Aborted</source>
            <translation type="unfinished">Abgebrochen</translation>
        </message>
        <message>
            <source>Unfinished</source>
            <translation type="unfinished">Unvollendet</translation>
        </message>
        <message>
            <source>Broken</source>
            <translation type="unfinished">Defekt</translation>
        </message>
        <message>
            <source>No attempt</source>
            <translation type="unfinished">Kein Versuch</translation>
        </message>
        <message>
            <source>Under way</source>
            <translation type="unfinished">Unterwegs</translation>
        </message>
        <message>
            <source>Scans</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Live pictures (Ctrl+T)</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>All panels (Ctrl+B)</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Pull out</source>
            <translation type="unfinished">Heraus</translation>
        </message>
        <message>
            <source>the patient's left</source>
            <translation type="unfinished">zur linken Patientenseite</translation>
        </message>
        <message>
            <source>the patient's right</source>
            <translation type="unfinished">zur rechten Patientenseite</translation>
        </message>
        <message>
            <source>the front</source>
            <translation type="unfinished">nach vorn</translation>
        </message>
        <message>
            <source>the back</source>
            <translation type="unfinished">nach hinten</translation>
        </message>
        <message>
            <source>the head</source>
            <translation type="unfinished">zum Kopf</translation>
        </message>
        <message>
            <source>the feet</source>
            <translation type="unfinished">zu den Füßen</translation>
        </message>
        <message>
            <source> (wheel away from you)</source>
            <translation type="unfinished"> (Rad von Ihnen weg)</translation>
        </message>
        <message>
            <source> (wheel towards you)</source>
            <translation type="unfinished"> (Rad zu Ihnen)</translation>
        </message>
        <message>
            <source> and </source>
            <translation type="unfinished"> und </translation>
        </message>
        <message>
            <source>Press F5 to start the attempt</source>
            <translation type="unfinished">Drücken Sie F5, um den Versuch zu starten</translation>
        </message>
        <message>
            <source>Aim {mm} mm further towards {sides}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Tilt the hub towards {sides}: {mm} mm off the target</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>One moment: the needle goes to its start</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Pull the needle out of the skin</source>
            <translation type="unfinished">Ziehen Sie die Nadel aus der Haut</translation>
        </message>
        <message>
            <source>Ready: the clock starts when you move</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Let both cameras see the marker</source>
            <translation type="unfinished">Lassen Sie beide Kameras den Marker sehen</translation>
        </message>
        <message>
            <source>Push by the scans: S takes one, Enter ends the attempt</source>
            <translation type="unfinished">Schieben Sie nach den Scans vor: S nimmt einen auf, Eingabe beendet den Versuch</translation>
        </message>
        <message>
            <source>Steer by the CT: S takes a scan, Enter ends the attempt</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Push the needle in{how}</source>
            <translation type="unfinished">Schieben Sie die Nadel vor{how}</translation>
        </message>
        <message>
            <source>Push slowly{how}: the cameras do not see the depth</source>
            <translation type="unfinished">Schieben Sie langsam vor{how}: Die Kameras sehen die Tiefe nicht</translation>
        </message>
        <message>
            <source>The tip stands on bone: do not push, pull back{how}</source>
            <translation type="unfinished">Die Spitze steht auf Knochen: nicht vorschieben, zurückziehen{how}</translation>
        </message>
        <message>
            <source>Push {mm} mm deeper{how}</source>
            <translation type="unfinished">Schieben Sie {mm} mm tiefer vor{how}</translation>
        </message>
        <message>
            <source>Pull back {mm} mm{how}</source>
            <translation type="unfinished">Ziehen Sie {mm} mm zurück{how}</translation>
        </message>
        <message>
            <source>Hold still</source>
            <translation type="unfinished">Halten Sie still</translation>
        </message>
        <message>
            <source>Bring the tip to the target</source>
            <translation type="unfinished">Bringen Sie die Spitze zum Ziel</translation>
        </message>
        <message>
            <source>Stay on the target</source>
            <translation type="unfinished">Bleiben Sie am Ziel</translation>
        </message>
        <message>
            <source>Press Enter: the tip is at the target</source>
            <translation type="unfinished">Drücken Sie Eingabe: Die Spitze ist am Ziel</translation>
        </message>
        <message>
            <source>Push deeper{how}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Pull back{how}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Aim further towards {sides}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Tilt the hub towards {sides}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Paused: the window was busy; it goes on by itself.</source>
            <translation type="unfinished">Pause: Das Fenster war ausgelastet; es geht von selbst weiter.</translation>
        </message>
        <message>
            <source>Paused: the needle swings in the simulated hand; it goes on by itself.</source>
            <translation type="unfinished">Pause: Die Nadel schwingt in der simulierten Hand; es geht von selbst weiter.</translation>
        </message>
        <message>
            <source>Paused: this computer is too busy. Close other programs; it goes on by itself.</source>
            <translation type="unfinished">Pause: Dieser Computer ist zu ausgelastet. Schließen Sie andere Programme; es geht von selbst weiter.</translation>
        </message>
        <message>
            <source>One moment: the robot is starting</source>
            <translation type="unfinished">Einen Moment: Der Roboter startet</translation>
        </message>
        <message>
            <source>✔ All {n} targets are touched: press Enter</source>
            <translation type="unfinished">✔ Alle Ziele sind berührt ({n}): Drücken Sie Eingabe</translation>
        </message>
        <message>
            <source>Stay on target {n} of {of}</source>
            <translation type="unfinished">Bleiben Sie am Ziel {n} von {of}</translation>
        </message>
        <message>
            <source>tip {mm} mm towards {sides} (hand the other way)</source>
            <translation type="unfinished">Spitze {mm} mm {sides} (Hand in die Gegenrichtung)</translation>
        </message>
        <message>
            <source>push {mm} mm</source>
            <translation type="unfinished">{mm} mm vorschieben</translation>
        </message>
        <message>
            <source>pull {mm} mm</source>
            <translation type="unfinished">{mm} mm zurückziehen</translation>
        </message>
        <message>
            <source>a little nearer</source>
            <translation type="unfinished">etwas näher</translation>
        </message>
        <message>
            <source>Target {n} of {of}: {way}</source>
            <translation type="unfinished">Ziel {n} von {of}: {way}</translation>
        </message>
        <message>
            <source>Held, {s:.0f} s left: </source>
            <translation type="unfinished">Atem angehalten, noch {s:.0f} s: </translation>
        </message>
        <message>
            <source>The patient breathes freely (A releases, A asks again): {step}</source>
            <translation type="unfinished">Der Patient atmet frei (A lässt los, noch einmal A bittet erneut): {step}</translation>
        </message>
        <message>
            <source>He breathes by himself: {step}</source>
            <translation type="unfinished">Er atmet von selbst: {step}</translation>
        </message>
        <message>
            <source>Wait: he breathes out and holds</source>
            <translation type="unfinished">Warten Sie: Er atmet aus und hält an</translation>
        </message>
        <message>
            <source>Have the breath held (A): {step}</source>
            <translation type="unfinished">Lassen Sie den Atem anhalten (A): {step}</translation>
        </message>
        <message>
            <source>Next step</source>
            <translation type="unfinished">Nächster Schritt</translation>
        </message>
        <message>
            <source>✔ Target {n} of {of} touched</source>
            <translation type="unfinished">✔ Ziel {n} von {of} berührt</translation>
        </message>
        <message>
            <source>The demonstration begins</source>
            <translation type="unfinished">Die Vorführung beginnt</translation>
        </message>
        <message>
            <source>Mask</source>
            <translation type="unfinished">Maske</translation>
        </message>
        <message>
            <source>Pixels that count as the marker's colour</source>
            <translation type="unfinished">Bildpunkte, die als Farbe des Markers zählen</translation>
        </message>
        <message>
            <source>Lines</source>
            <translation type="unfinished">Linien</translation>
        </message>
        <message>
            <source>Where the marker may lie by what the other camera shows; it should pass through the marker</source>
            <translation type="unfinished">Wo der Marker liegen kann, nach dem, was die andere Kamera zeigt; sie sollte durch den Marker gehen</translation>
        </message>
        <message>
            <source>Region</source>
            <translation type="unfinished">Bereich</translation>
        </message>
        <message>
            <source>Where the marker is looked for in the next picture</source>
            <translation type="unfinished">Wo der Marker im nächsten Bild gesucht wird</translation>
        </message>
        <message>
            <source>Zoom</source>
            <translation type="unfinished">Zoom</translation>
        </message>
        <message>
            <source>The marker's surroundings, enlarged</source>
            <translation type="unfinished">Die Umgebung des Markers, vergrößert</translation>
        </message>
        <message>
            <source>Learn</source>
            <translation type="unfinished">Lernen</translation>
        </message>
        <message>
            <source>Learn the marker's colour: press, then click on the marker in a picture</source>
            <translation type="unfinished">Farbe des Markers lernen: Drücken Sie und klicken Sie dann in einem Bild auf den Marker</translation>
        </message>
        <message>
            <source>± {mm:.2f} mm</source>
            <translation type="unfinished">± {mm:.2f} mm</translation>
        </message>
        <message>
            <source>{size} + calibration (not known)</source>
            <translation type="unfinished">{size} + Kalibrierung (unbekannt)</translation>
        </message>
        <message>
            <source>From the pictures alone: the calibration was imported, so its own uncertainty is unknown. The true radius is larger; calibrate with pictures of a board to learn it</source>
            <translation type="unfinished">Allein aus den Bildern: Die Kalibrierung wurde importiert, ihre eigene Unsicherheit ist unbekannt. Der wahre Radius ist größer; kalibrieren Sie mit Bildern einer Tafel, um ihn zu erfahren</translation>
        </message>
        <message>
            <source>{rate:.0f} pairs/s</source>
            <translation type="unfinished">{rate:.0f} Paare/s</translation>
        </message>
        <message>
            <source>{share:.0f} %</source>
            <translation type="unfinished">{share:.0f} %</translation>
        </message>
        <message>
            <source>{ms:.1f} ms</source>
            <translation type="unfinished">{ms:.1f} ms</translation>
        </message>
        <message>
            <source>&lt; 0.01 px</source>
            <translation type="unfinished">&lt; 0.01 px</translation>
        </message>
        <message>
            <source>How far the two pictures disagree; above 1 px the calibration should be checked. It is no accuracy: a wrong scale leaves it small</source>
            <translation type="unfinished">Wie weit die beiden Bilder einander widersprechen; über 1 px sollte die Kalibrierung geprüft werden. Das ist keine Genauigkeit: Ein falscher Maßstab lässt den Wert klein</translation>
        </message>
        <message>
            <source>Tip, 95 %</source>
            <translation type="unfinished">Spitze, 95 %</translation>
        </message>
        <message>
            <source>Radius round the tip that holds the true one with 95 %, by pictures and calibration</source>
            <translation type="unfinished">Radius um die Spitze, in dem die wahre mit 95 % liegt, nach Bildern und Kalibrierung</translation>
        </message>
        <message>
            <source>Rate</source>
            <translation type="unfinished">Rate</translation>
        </message>
        <message>
            <source>Pairs of pictures a second</source>
            <translation type="unfinished">Bildpaare je Sekunde</translation>
        </message>
        <message>
            <source>Valid</source>
            <translation type="unfinished">Gültig</translation>
        </message>
        <message>
            <source>Share of pairs in which both cameras saw the marker</source>
            <translation type="unfinished">Anteil der Paare, in denen beide Kameras den Marker sahen</translation>
        </message>
        <message>
            <source>From capture to the needle's place, median</source>
            <translation type="unfinished">Von der Aufnahme bis zum Ort der Nadel, Median</translation>
        </message>
        <message>
            <source>Skew</source>
            <translation type="unfinished">Versatz</translation>
        </message>
        <message>
            <source>Capture of the right picture after the left one; it is made up for</source>
            <translation type="unfinished">Aufnahme des rechten Bildes nach dem linken; wird ausgeglichen</translation>
        </message>
        <message>
            <source>Only the instructor does that: change the role at the top right.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>(erased)</source>
            <translation type="unfinished">(gelöscht)</translation>
        </message>
        <message>
            <source>it is an assessment of the course {course}. Sign in as a student who takes it (Sessions ▸ Sign in as a student…), or as the instructor (role, at the top right)</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{x}   {y}   {z} mm</source>
            <translation type="unfinished">{x}   {y}   {z} mm</translation>
        </message>
        <message>
            <source>is empty: type something</source>
            <translation type="unfinished">ist leer: Geben Sie etwas ein</translation>
        </message>
        <message>
            <source>is too long: at most {n} characters</source>
            <translation type="unfinished">ist zu lang: höchstens {n} Zeichen</translation>
        </message>
        <message>
            <source>{value} cannot be used: small letters, digits and single hyphens, such as autumn-2026</source>
            <translation type="unfinished">{value} ist nicht verwendbar: Kleinbuchstaben, Ziffern und einzelne Bindestriche, etwa autumn-2026</translation>
        </message>
        <message>
            <source>is empty: small letters, digits and hyphens, such as autumn-2026</source>
            <translation type="unfinished">ist leer: Kleinbuchstaben, Ziffern und Bindestriche, etwa autumn-2026</translation>
        </message>
        <message>
            <source>{value} is no number: type one, such as 2.5</source>
            <translation type="unfinished">{value} ist keine Zahl: Geben Sie eine ein, etwa 2.5</translation>
        </message>
        <message>
            <source>{value} is no whole number: type one, such as 2</source>
            <translation type="unfinished">{value} ist keine ganze Zahl: Geben Sie eine ein, etwa 2</translation>
        </message>
        <message>
            <source>{value} is no day: write year-month-day, such as 2026-11-30</source>
            <translation type="unfinished">{value} ist kein Datum: Schreiben Sie Jahr-Monat-Tag, etwa 2026-11-30</translation>
        </message>
        <message>
            <source>{value} is too small: at least {n}</source>
            <translation type="unfinished">{value} ist zu klein: mindestens {n}</translation>
        </message>
        <message>
            <source>{value} is too large: at most {n}</source>
            <translation type="unfinished">{value} ist zu groß: höchstens {n}</translation>
        </message>
        <message>
            <source>{value} is too small: more than {n}</source>
            <translation type="unfinished">{value} ist zu klein: größer als {n}</translation>
        </message>
        <message>
            <source>{value} is too large: less than {n}</source>
            <translation type="unfinished">{value} ist zu groß: kleiner als {n}</translation>
        </message>
        <message>
            <source>{value} cannot be used: {n}</source>
            <translation type="unfinished">{value} ist nicht verwendbar: {n}</translation>
        </message>
        <message>
            <source>is missing: fill it in</source>
            <translation type="unfinished">fehlt: Füllen Sie es aus</translation>
        </message>
        <message>
            <source>row {n}</source>
            <translation type="unfinished">Zeile {n}</translation>
        </message>
        <message>
            <source>none yet</source>
            <translation type="unfinished">noch nichts</translation>
        </message>
        <message>
            <source>Cancelling…</source>
            <translation type="unfinished">Wird abgebrochen…</translation>
        </message>
        <message>
            <source>{work} (and {count} more)</source>
            <translation type="unfinished">{work} (und {count} weitere)</translation>
        </message>
        <message>
            <source>Training only. Not a medical device; not for diagnosis or patient care.</source>
            <translation type="unfinished">Nur zum Training. Kein Medizinprodukt; nicht für Diagnose oder Patientenversorgung.</translation>
        </message>
        <message>
            <source>Next</source>
            <translation type="unfinished">Weiter</translation>
        </message>
        <message>
            <source>Close</source>
            <translation type="unfinished">Schließen</translation>
        </message>
        <message>
            <source>Distance</source>
            <translation type="unfinished">Abstand</translation>
        </message>
        <message>
            <source>Angle</source>
            <translation type="unfinished">Winkel</translation>
        </message>
        <message>
            <source>HU probe</source>
            <translation type="unfinished">HU-Messpunkt</translation>
        </message>
        <message>
            <source>Region (mean)</source>
            <translation type="unfinished">Region (Mittel)</translation>
        </message>
        <message>
            <source>Drag from point to point</source>
            <translation type="unfinished">Von Punkt zu Punkt ziehen</translation>
        </message>
        <message>
            <source>Drag along one side to the vertex, then click the other side</source>
            <translation type="unfinished">Entlang einer Seite bis zum Scheitel ziehen, dann die andere Seite anklicken</translation>
        </message>
        <message>
            <source>Click: the value of that voxel</source>
            <translation type="unfinished">Klick: der Wert dieses Voxels</translation>
        </message>
        <message>
            <source>Drag from corner to corner: mean ± deviation and area of the ellipse</source>
            <translation type="unfinished">Von Ecke zu Ecke ziehen: Mittel ± Abweichung und Fläche der Ellipse</translation>
        </message>
        <message>
            <source>Remove all</source>
            <translation type="unfinished">Alle entfernen</translation>
        </message>
        <message>
            <source>{kind}: type to name it</source>
            <translation type="unfinished">{kind}: Zum Benennen tippen</translation>
        </message>
        <message>
            <source>Name</source>
            <translation type="unfinished">Name</translation>
        </message>
        <message>
            <source>Measurements</source>
            <translation type="unfinished">Messungen</translation>
        </message>
        <message>
            <source>Double click on a value: the slices go there</source>
            <translation type="unfinished">Doppelklick auf einen Wert: Die Schichten gehen dorthin</translation>
        </message>
        <message>
            <source>Measure</source>
            <translation type="unfinished">Messen</translation>
        </message>
        <message>
            <source>&amp;Measure</source>
            <translation type="unfinished">&amp;Messen</translation>
        </message>
        <message>
            <source>3D Slicer</source>
            <translation type="unfinished">3D Slicer</translation>
        </message>
        <message>
            <source>Export measurements</source>
            <translation type="unfinished">Messungen exportieren</translation>
        </message>
        <message>
            <source>List of measurements</source>
            <translation type="unfinished">Liste der Messungen</translation>
        </message>
        <message>
            <source>Export measurements…</source>
            <translation type="unfinished">Messungen exportieren…</translation>
        </message>
        <message>
            <source>Retrieving from {name}</source>
            <translation type="unfinished">Abruf von {name}</translation>
        </message>
        <message>
            <source>From the PACS…</source>
            <translation type="unfinished">Aus dem PACS…</translation>
        </message>
        <message>
            <source>Configure PACS…</source>
            <translation type="unfinished">PACS einrichten…</translation>
        </message>
        <message>
            <source>PACS</source>
            <translation type="unfinished">PACS</translation>
        </message>
        <message>
            <source>Search</source>
            <translation type="unfinished">Suchen</translation>
        </message>
        <message>
            <source>Configure…</source>
            <translation type="unfinished">Einrichten…</translation>
        </message>
        <message>
            <source>Take into the library, de-identified</source>
            <translation type="unfinished">De-identifiziert in die Bibliothek übernehmen</translation>
        </message>
        <message>
            <source>Searching…</source>
            <translation type="unfinished">Suche läuft…</translation>
        </message>
        <message>
            <source>Searching {name}</source>
            <translation type="unfinished">Suche in {name}</translation>
        </message>
        <message>
            <source>Series</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>* and ? stand for unknown characters</source>
            <translation type="unfinished">* und ? stehen für unbekannte Zeichen</translation>
        </message>
        <message>
            <source>FAMILY^GIVEN, with * and ?</source>
            <translation type="unfinished">NACHNAME^VORNAME, mit * und ?</translation>
        </message>
        <message>
            <source>YYYYMMDD or YYYYMMDD-YYYYMMDD</source>
            <translation type="unfinished">JJJJMMTT oder JJJJMMTT-JJJJMMTT</translation>
        </message>
        <message>
            <source>Patient ID</source>
            <translation type="unfinished">Patienten-ID</translation>
        </message>
        <message>
            <source>Date of the study</source>
            <translation type="unfinished">Datum der Studie</translation>
        </message>
        <message>
            <source>Names are shown here only; nothing of them is stored.</source>
            <translation type="unfinished">Namen werden nur hier gezeigt; nichts davon wird gespeichert.</translation>
        </message>
        <message>
            <source>No PACS is configured yet: press Configure…</source>
            <translation type="unfinished">Noch ist kein PACS eingerichtet: Drücken Sie Einrichten…</translation>
        </message>
        <message>
            <source>{here} of {count} here, to be resumed</source>
            <translation type="unfinished">{here} von {count} hier, fortsetzbar</translation>
        </message>
        <message>
            <source>C-GET: over the same connection</source>
            <translation type="unfinished">C-GET: über dieselbe Verbindung</translation>
        </message>
        <message>
            <source>C-MOVE: it connects to us</source>
            <translation type="unfinished">C-MOVE: es verbindet sich mit uns</translation>
        </message>
        <message>
            <source>Encrypted connection (TLS)</source>
            <translation type="unfinished">Verschlüsselte Verbindung (TLS)</translation>
        </message>
        <message>
            <source>Its certificate must name the host</source>
            <translation type="unfinished">Das Zertifikat muss den Host nennen</translation>
        </message>
        <message>
            <source>what it is called here; no blanks</source>
            <translation type="unfinished">wie es hier heißt; keine Leerzeichen</translation>
        </message>
        <message>
            <source>Host</source>
            <translation type="unfinished">Host</translation>
        </message>
        <message>
            <source>name or address of the archive</source>
            <translation type="unfinished">Name oder Adresse des Archivs</translation>
        </message>
        <message>
            <source>Port</source>
            <translation type="unfinished">Port</translation>
        </message>
        <message>
            <source>AE title</source>
            <translation type="unfinished">AE-Titel</translation>
        </message>
        <message>
            <source>the archive's, at most 16 characters</source>
            <translation type="unfinished">der des Archivs, höchstens 16 Zeichen</translation>
        </message>
        <message>
            <source>Own AE title</source>
            <translation type="unfinished">Eigener AE-Titel</translation>
        </message>
        <message>
            <source>tell the archive's administrator</source>
            <translation type="unfinished">dem Administrator des Archivs mitteilen</translation>
        </message>
        <message>
            <source>Retrieve by</source>
            <translation type="unfinished">Abrufen mit</translation>
        </message>
        <message>
            <source>Own address</source>
            <translation type="unfinished">Eigene Adresse</translation>
        </message>
        <message>
            <source>empty: the one that leads to the archive</source>
            <translation type="unfinished">leer: diejenige, die zum Archiv führt</translation>
        </message>
        <message>
            <source>Own port</source>
            <translation type="unfinished">Eigener Port</translation>
        </message>
        <message>
            <source>Other senders</source>
            <translation type="unfinished">Andere Absender</translation>
        </message>
        <message>
            <source>empty: pictures come from the host alone</source>
            <translation type="unfinished">leer: Bilder kommen nur vom Host</translation>
        </message>
        <message>
            <source>Longest silence</source>
            <translation type="unfinished">Längste Stille</translation>
        </message>
        <message>
            <source>Authority</source>
            <translation type="unfinished">Zertifizierungsstelle</translation>
        </message>
        <message>
            <source>PEM; empty: those that the system trusts</source>
            <translation type="unfinished">PEM; leer: diejenigen, denen das System vertraut</translation>
        </message>
        <message>
            <source>Own certificate</source>
            <translation type="unfinished">Eigenes Zertifikat</translation>
        </message>
        <message>
            <source>PEM; where the archive asks for one</source>
            <translation type="unfinished">PEM; falls das Archiv eines verlangt</translation>
        </message>
        <message>
            <source>Own key</source>
            <translation type="unfinished">Eigener Schlüssel</translation>
        </message>
        <message>
            <source>PEM without a password</source>
            <translation type="unfinished">PEM ohne Passwort</translation>
        </message>
        <message>
            <source>Own address and port are where C-MOVE's pictures come; the port is open only while a retrieval lasts.</source>
            <translation type="unfinished">An eigener Adresse und eigenem Port kommen die Bilder von C-MOVE an; der Port ist nur während eines Abrufs offen.</translation>
        </message>
        <message>
            <source>Choose…</source>
            <translation type="unfinished">Wählen…</translation>
        </message>
        <message>
            <source>Choose a file</source>
            <translation type="unfinished">Datei wählen</translation>
        </message>
        <message>
            <source>PACS: configuration</source>
            <translation type="unfinished">PACS: Konfiguration</translation>
        </message>
        <message>
            <source>Add</source>
            <translation type="unfinished">Hinzufügen</translation>
        </message>
        <message>
            <source>Test (C-ECHO)</source>
            <translation type="unfinished">Testen (C-ECHO)</translation>
        </message>
        <message>
            <source>Asking {name}…</source>
            <translation type="unfinished">{name} wird gefragt…</translation>
        </message>
        <message>
            <source>{name} answers in {time} ms</source>
            <translation type="unfinished">{name} antwortet in {time} ms</translation>
        </message>
        <message>
            <source>Cancelled</source>
            <translation type="unfinished">Abgebrochen</translation>
        </message>
        <message>
            <source>Asking {name}</source>
            <translation type="unfinished">{name} wird gefragt</translation>
        </message>
        <message>
            <source>The name {name} is given twice</source>
            <translation type="unfinished">Der Name {name} ist zweimal vergeben</translation>
        </message>
        <message>
            <source>It cannot be written: {why}</source>
            <translation type="unfinished">Schreiben nicht möglich: {why}</translation>
        </message>
        <message>
            <source>The changes are not saved. Save them first?</source>
            <translation type="unfinished">Die Änderungen sind nicht gespeichert. Zuerst speichern?</translation>
        </message>
        <message>
            <source>Save replaces the file.</source>
            <translation type="unfinished">Speichern ersetzt die Datei.</translation>
        </message>
        <message>
            <source>Configured PACS</source>
            <translation type="unfinished">Eingerichtete PACS</translation>
        </message>
        <message>
            <source>without a name</source>
            <translation type="unfinished">ohne Namen</translation>
        </message>
        <message>
            <source>guessed from the pictures' size</source>
            <translation type="unfinished">aus der Bildgröße geschätzt</translation>
        </message>
        <message>
            <source>a calibration's file…</source>
            <translation type="unfinished">eine Kalibrierungsdatei…</translation>
        </message>
        <message>
            <source>A guess is good for trying out. `acus calibrate mono --images FOLDER --out lens.yaml` measures the lens; of a calibrated pair of cameras either may be taken</source>
            <translation type="unfinished">Zum Ausprobieren genügt eine Schätzung. `acus calibrate mono --images FOLDER --out lens.yaml` vermisst das Objektiv; von einem kalibrierten Kamerapaar taugt jede der beiden</translation>
        </message>
        <message>
            <source>Calibration of the webcam</source>
            <translation type="unfinished">Kalibrierung der Webcam</translation>
        </message>
        <message>
            <source>Calibrations (*.yaml *.yml)</source>
            <translation type="unfinished">Kalibrierungen (*.yaml *.yml)</translation>
        </message>
        <message>
            <source>written to {file}: print it at 100 %, check the line of 100 mm, cut, fold, glue</source>
            <translation type="unfinished">gespeichert in {file}: mit 100 % drucken, die Linie von 100 mm nachmessen, ausschneiden, falten, kleben</translation>
        </message>
        <message>
            <source>Save the pen</source>
            <translation type="unfinished">Stift speichern</translation>
        </message>
        <message>
            <source>Cube: five faces, also seen from above. Ring: six faces round the shaft</source>
            <translation type="unfinished">Würfel: fünf Flächen, auch von oben zu sehen. Ring: sechs Flächen rund um den Schaft</translation>
        </message>
        <message>
            <source>Edge of a face. Larger is more accurate, and heavier</source>
            <translation type="unfinished">Kantenlänge einer Fläche. Größer ist genauer, aber schwerer</translation>
        </message>
        <message>
            <source>Width and height of the webcam's pictures</source>
            <translation type="unfinished">Breite und Höhe der Webcam-Bilder</translation>
        </message>
        <message>
            <source>Paper of the printer</source>
            <translation type="unfinished">Papier des Druckers</translation>
        </message>
        <message>
            <source>The net of the pen and the sheet for the table, at true size</source>
            <translation type="unfinished">Bastelbogen des Stifts und Blatt für den Tisch, in wahrer Größe</translation>
        </message>
        <message>
            <source>&amp;Pen</source>
            <translation type="unfinished">S&amp;tift</translation>
        </message>
        <message>
            <source>&amp;Webcam</source>
            <translation type="unfinished">&amp;Webcam</translation>
        </message>
        <message>
            <source>&amp;Lens</source>
            <translation type="unfinished">&amp;Objektiv</translation>
        </message>
        <message>
            <source>Print</source>
            <translation type="unfinished">Drucken</translation>
        </message>
        <message>
            <source>Pen and webcam: a needle without a robot</source>
            <translation type="unfinished">Stift und Webcam: eine Nadel ohne Roboter</translation>
        </message>
        <message>
            <source>&amp;Use the pen as needle</source>
            <translation type="unfinished">Stift als &amp;Nadel verwenden</translation>
        </message>
        <message>
            <source>Back to the &amp;robot</source>
            <translation type="unfinished">Zurück zum &amp;Roboter</translation>
        </message>
        <message>
            <source>&amp;Try again</source>
            <translation type="unfinished">&amp;Erneut versuchen</translation>
        </message>
        <message>
            <source>the webcam could not be opened</source>
            <translation type="unfinished">die Webcam ließ sich nicht öffnen</translation>
        </message>
        <message>
            <source>stopped, nothing is changed</source>
            <translation type="unfinished">abgebrochen, nichts wurde geändert</translation>
        </message>
        <message>
            <source>Measured tip</source>
            <translation type="unfinished">Vermessene Spitze</translation>
        </message>
        <message>
            <source>Save the measured tip?</source>
            <translation type="unfinished">Vermessene Spitze speichern?</translation>
        </message>
        <message>
            <source>The next attempts are made with the pen, without a robot</source>
            <translation type="unfinished">Die nächsten Versuche werden mit dem Stift gemacht, ohne Roboter</translation>
        </message>
        <message>
            <source>The robot, or the simulated one, holds the needle again</source>
            <translation type="unfinished">Der Roboter, echt oder simuliert, hält wieder die Nadel</translation>
        </message>
        <message>
            <source>&amp;Use this pen</source>
            <translation type="unfinished">Diesen Stift &amp;verwenden</translation>
        </message>
        <message>
            <source>Open the webcam again, for instance after plugging it in</source>
            <translation type="unfinished">Webcam erneut öffnen, etwa nach dem Anschließen</translation>
        </message>
        <message>
            <source>Which pen</source>
            <translation type="unfinished">Welcher Stift</translation>
        </message>
        <message>
            <source>Its tip</source>
            <translation type="unfinished">Seine Spitze</translation>
        </message>
        <message>
            <source>The pen is the needle now: {source}</source>
            <translation type="unfinished">Jetzt ist der Stift die Nadel: {source}</translation>
        </message>
        <message>
            <source>The pen is the needle now. Choose an exercise: it runs on the pen</source>
            <translation type="unfinished">Jetzt ist der Stift die Nadel. Wählen Sie eine Übung: Sie läuft mit dem Stift</translation>
        </message>
        <message>
            <source>The robot holds the needle</source>
            <translation type="unfinished">Der Roboter hält die Nadel</translation>
        </message>
        <message>
            <source>Pen and webcam: set up, measure, print…</source>
            <translation type="unfinished">Stift und Webcam: einrichten, vermessen, drucken…</translation>
        </message>
        <message>
            <source>A needle without a robot: docs/pen.md</source>
            <translation type="unfinished">Eine Nadel ohne Roboter: docs/pen.md</translation>
        </message>
        <message>
            <source>A pen before a webcam: {source}</source>
            <translation type="unfinished">Ein Stift vor einer Webcam: {source}</translation>
        </message>
        <message>
            <source>A pen before a webcam: choose…</source>
            <translation type="unfinished">Ein Stift vor einer Webcam: wählen…</translation>
        </message>
        <message>
            <source>Pen {name}</source>
            <translation type="unfinished">Stift {name}</translation>
        </message>
        <message>
            <source>Print at 100 %, not “fit to page”: the line is 100 mm, a black square {side:.1f} mm; {how}.</source>
            <translation type="unfinished">Mit 100 % drucken, nicht „an Seite anpassen“: Die Linie ist 100 mm lang, ein schwarzes Quadrat {side:.1f} mm; {how}.</translation>
        </message>
        <message>
            <source>lay it on a box and punch the cross: the shaft goes through it</source>
            <translation type="unfinished">auf eine Schachtel legen und das Kreuz durchstechen: Dort geht der Schaft hindurch</translation>
        </message>
        <message>
            <source>cut, fold along the lines and close it round two discs of cardboard, {across:.0f} mm from side to side; the shaft goes through their middles</source>
            <translation type="unfinished">ausschneiden, an den Linien falten und um zwei Pappscheiben schließen, von Seite zu Seite {across:.0f} mm; der Schaft geht durch ihre Mitten</translation>
        </message>
        <message>
            <source>cut along the outside, fold along the lines, glue the tabs inside; the shaft goes through both crosses</source>
            <translation type="unfinished">außen ausschneiden, an den Linien falten, die Laschen innen ankleben; der Schaft geht durch beide Kreuze</translation>
        </message>
        <message>
            <source>Radius round the shown tip that holds the true one in 95 of 100 cases: noise, print, lens and the tip's own place are all in it</source>
            <translation type="unfinished">Radius um die gezeigte Spitze, in dem die wahre in 95 von 100 Fällen liegt: Rauschen, Druck, Objektiv und die Lage der Spitze selbst sind darin enthalten</translation>
        </message>
        <message>
            <source>Seen from above, the webcam at the bottom. A sector fills when the pen has leant that way; the dot is how it leans now</source>
            <translation type="unfinished">Von oben gesehen, die Webcam unten. Ein Sektor füllt sich, wenn der Stift sich dorthin geneigt hat; der Punkt zeigt die jetzige Neigung</translation>
        </message>
        <message>
            <source>away</source>
            <translation type="unfinished">hinten</translation>
        </message>
        <message>
            <source>webcam</source>
            <translation type="unfinished">Webcam</translation>
        </message>
        <message>
            <source>&amp;Measure the tip</source>
            <translation type="unfinished">Spitze ver&amp;messen</translation>
        </message>
        <message>
            <source>Compute now</source>
            <translation type="unfinished">Jetzt berechnen</translation>
        </message>
        <message>
            <source>&amp;Save</source>
            <translation type="unfinished">&amp;Speichern</translation>
        </message>
        <message>
            <source>stopped: pen or webcam are others now</source>
            <translation type="unfinished">abgebrochen: Stift oder Webcam haben gewechselt</translation>
        </message>
        <message>
            <source>{n} of {all} positions</source>
            <translation type="unfinished">{n} von {all} Stellungen</translation>
        </message>
        <message>
            <source>; still missing: {side}</source>
            <translation type="unfinished">; es fehlt noch: {side}</translation>
        </message>
        <message>
            <source>; all sides are covered, go on rocking</source>
            <translation type="unfinished">; alle Seiten sind erfasst, weiter schwenken</translation>
        </message>
        <message>
            <source>saved and in use</source>
            <translation type="unfinished">gespeichert und in Gebrauch</translation>
        </message>
        <message>
            <source>the tip before is in use</source>
            <translation type="unfinished">die vorige Spitze ist in Gebrauch</translation>
        </message>
        <message>
            <source>the drawing's tip is in use</source>
            <translation type="unfinished">die Spitze laut Zeichnung ist in Gebrauch</translation>
        </message>
        <message>
            <source>&amp;Measure again</source>
            <translation type="unfinished">Erneut ver&amp;messen</translation>
        </message>
        <message>
            <source>A simulated pen's tip is not saved: it would be mistaken for the real one's</source>
            <translation type="unfinished">Die Spitze eines simulierten Stifts wird nicht gespeichert: Man hielte sie sonst für die des echten</translation>
        </message>
        <message>
            <source>Keep this tip; it is used from now on</source>
            <translation type="unfinished">Diese Spitze behalten; sie gilt von jetzt an</translation>
        </message>
        <message>
            <source>done; a simulated pen is practice only and is not kept</source>
            <translation type="unfinished">fertig; ein simulierter Stift dient nur zum Üben und wird nicht behalten</translation>
        </message>
        <message>
            <source>measured, not saved yet</source>
            <translation type="unfinished">vermessen, noch nicht gespeichert</translation>
        </message>
        <message>
            <source>Use the tip before this one; once more uses this one again</source>
            <translation type="unfinished">Die vorige Spitze verwenden; noch einmal, und diese gilt wieder</translation>
        </message>
        <message>
            <source>Do not wait for all positions and sides</source>
            <translation type="unfinished">Nicht auf alle Stellungen und Seiten warten</translation>
        </message>
        <message>
            <source>Stand the tip in a dimple on the sheet, hold it there, and rock the pen slowly to every side, by 30°.</source>
            <translation type="unfinished">Setzen Sie die Spitze in eine Mulde auf dem Blatt, halten Sie sie dort und schwenken Sie den Stift langsam nach allen Seiten, um 30°.</translation>
        </message>
        <message>
            <source>The needle is not seen: {why}</source>
            <translation type="unfinished">Die Nadel ist nicht zu sehen: {why}</translation>
        </message>
        <message>
            <source>waiting for the first picture …</source>
            <translation type="unfinished">wartet auf das erste Bild …</translation>
        </message>
        <message>
            <source>The needle's position is unknown: {why}</source>
            <translation type="unfinished">Die Lage der Nadel ist unbekannt: {why}</translation>
        </message>
        <message>
            <source>The tip is known to ±N{NO-BREAK SPACE}{mm:.1f} mm (95 %), the direction to ±N{NO-BREAK SPACE}{deg:.1f}°</source>
            <translation type="unfinished">Die Spitze ist auf ±N{NO-BREAK SPACE}{mm:.1f} mm bekannt (95 %), die Richtung auf ±N{NO-BREAK SPACE}{deg:.1f}°</translation>
        </message>
        <message>
            <source>known exactly: the webcam is simulated</source>
            <translation type="unfinished">genau bekannt: Die Webcam ist simuliert</translation>
        </message>
        <message>
            <source>the lens is {source}</source>
            <translation type="unfinished">das Objektiv ist {source}</translation>
        </message>
        <message>
            <source>the lens is calibrated</source>
            <translation type="unfinished">das Objektiv ist kalibriert</translation>
        </message>
        <message>
            <source>the lens is guessed: `acus calibrate mono` measures it, then choose its file</source>
            <translation type="unfinished">das Objektiv ist geschätzt: `acus calibrate mono` vermisst es, wählen Sie dann seine Datei</translation>
        </message>
        <message>
            <source>the tip is measured</source>
            <translation type="unfinished">die Spitze ist vermessen</translation>
        </message>
        <message>
            <source>the tip is where the drawing has it: measure it</source>
            <translation type="unfinished">die Spitze liegt, wo die Zeichnung sie hat: Vermessen Sie sie</translation>
        </message>
        <message>
            <source>tip known to {sd:.2f} mm (standard deviation, worst direction)</source>
            <translation type="unfinished">Spitze auf {sd:.2f} mm bekannt (Standardabweichung, ungünstigste Richtung)</translation>
        </message>
        <message>
            <source>it stood still to {rms:.2f} mm in {n} positions, {out} left out</source>
            <translation type="unfinished">sie stand auf {rms:.2f} mm still; Stellungen: {n}, davon weggelassen: {out}</translation>
        </message>
        <message>
            <source>too few positions to hold any back</source>
            <translation type="unfinished">zu wenige Stellungen, um welche zur Probe zurückzuhalten</translation>
        </message>
        <message>
            <source>{n} positions held back: {rms:.2f} mm off (at most {worst:.1f} mm)</source>
            <translation type="unfinished">zurückgehaltene Stellungen: {n}; {rms:.2f} mm daneben (höchstens {worst:.1f} mm)</translation>
        </message>
        <message>
            <source>direction of the shaft to {deg:.2f}°</source>
            <translation type="unfinished">Richtung des Schafts auf {deg:.2f}°</translation>
        </message>
        <message>
            <source>{faces} of {all} faces of the {name} and {sheet} markers of the sheet are seen</source>
            <translation type="unfinished">zu sehen: {faces} von {all} Flächen von {name}, Marker des Blatts: {sheet}</translation>
        </message>
        <message>
            <source>; two faces tell more: turn a corner of the {name} to the webcam</source>
            <translation type="unfinished">; zwei Flächen sagen mehr: Drehen Sie eine Ecke von {name} zur Webcam</translation>
        </message>
        <message>
            <source>show a whole face to the webcam; come nearer, give more light</source>
            <translation type="unfinished">zeigen Sie der Webcam eine ganze Fläche; gehen Sie näher heran, sorgen Sie für mehr Licht</translation>
        </message>
        <message>
            <source>show the sheet too, with nothing lying on its markers</source>
            <translation type="unfinished">zeigen Sie auch das Blatt, ohne dass etwas auf seinen Markern liegt</translation>
        </message>
        <message>
            <source>the pen is held still enough</source>
            <translation type="unfinished">der Stift wird ruhig genug gehalten</translation>
        </message>
        <message>
            <source>hold still: at {speed:.0f} mm/s the picture blurs</source>
            <translation type="unfinished">ruhig halten: Bei {speed:.0f} mm/s verwischt das Bild</translation>
        </message>
        <message>
            <source>Progress, students and courses</source>
            <translation type="unfinished">Fortschritt, Teilnehmer und Kurse</translation>
        </message>
        <message>
            <source>Sign in as a student…</source>
            <translation type="unfinished">Als Teilnehmer anmelden…</translation>
        </message>
        <message>
            <source>Sign in as the instructor…</source>
            <translation type="unfinished">Als Kursleiter anmelden…</translation>
        </message>
        <message>
            <source>Sign out</source>
            <translation type="unfinished">Abmelden</translation>
        </message>
        <message>
            <source>Back up everything…</source>
            <translation type="unfinished">Alles sichern…</translation>
        </message>
        <message>
            <source>Pseudonym</source>
            <translation type="unfinished">Pseudonym</translation>
        </message>
        <message>
            <source>PIN</source>
            <translation type="unfinished">PIN</translation>
        </message>
        <message>
            <source>Sign in</source>
            <translation type="unfinished">Anmelden</translation>
        </message>
        <message>
            <source>Password</source>
            <translation type="unfinished">Passwort</translation>
        </message>
        <message>
            <source>Sign in as the instructor</source>
            <translation type="unfinished">Als Kursleiter anmelden</translation>
        </message>
        <message>
            <source>No password is set yet: whoever is here may do everything. A password keeps students from people, courses, deleting and exports. It guards against curiosity, not against the owner of the disk.</source>
            <translation type="unfinished">Es ist noch kein Passwort gesetzt: Wer hier ist, darf alles. Ein Passwort hält Teilnehmer von Personen, Kursen, Löschen und Exporten fern. Es schützt vor Neugier, nicht vor dem Besitzer der Festplatte.</translation>
        </message>
        <message>
            <source>the two passwords are not the same: type them again</source>
            <translation type="unfinished">die beiden Passwörter sind nicht gleich: Geben Sie sie noch einmal ein</translation>
        </message>
        <message>
            <source>Recovery key</source>
            <translation type="unfinished">Wiederherstellungsschlüssel</translation>
        </message>
        <message>
            <source>Write this down and lock it away: it sets a new password, and opens the station's key in a backup. It is not stored anywhere.</source>
            <translation type="unfinished">Schreiben Sie ihn auf und schließen Sie ihn weg: Damit lässt sich ein neues Passwort setzen und der Schlüssel der Station in einer Sicherung öffnen. Er wird nirgends gespeichert.</translation>
        </message>
        <message>
            <source>New password</source>
            <translation type="unfinished">Neues Passwort</translation>
        </message>
        <message>
            <source>Set the instructor's password</source>
            <translation type="unfinished">Passwort des Kursleiters setzen</translation>
        </message>
        <message>
            <source>Sign in first: as a student, or as the instructor.</source>
            <translation type="unfinished">Melden Sie sich zuerst an: als Teilnehmer oder als Kursleiter.</translation>
        </message>
        <message>
            <source>Reading the attempts</source>
            <translation type="unfinished">Versuche werden gelesen</translation>
        </message>
        <message>
            <source>PIN (empty: drawn)</source>
            <translation type="unfinished">PIN (leer: wird ausgelost)</translation>
        </message>
        <message>
            <source>Groups</source>
            <translation type="unfinished">Gruppen</translation>
        </message>
        <message>
            <source>The pseudonym is what screens show; the name is kept apart from all records.</source>
            <translation type="unfinished">Das Pseudonym ist das, was Bildschirme zeigen; der Name bleibt von allen Aufzeichnungen getrennt.</translation>
        </message>
        <message>
            <source>Hand this out; it is not stored anywhere.</source>
            <translation type="unfinished">Geben Sie sie weiter; sie wird nirgends gespeichert.</translation>
        </message>
        <message>
            <source>Add a student</source>
            <translation type="unfinished">Teilnehmer hinzufügen</translation>
        </message>
        <message>
            <source>CSV (*.csv *.txt)</source>
            <translation type="unfinished">CSV (*.csv *.txt)</translation>
        </message>
        <message>
            <source>Roster</source>
            <translation type="unfinished">Teilnehmerliste</translation>
        </message>
        <message>
            <source>Taking the roster</source>
            <translation type="unfinished">Teilnehmerliste wird übernommen</translation>
        </message>
        <message>
            <source>Nothing was imported. Correct these rows and import the roster again:</source>
            <translation type="unfinished">Nichts wurde importiert. Berichtigen Sie diese Zeilen und importieren Sie die Teilnehmerliste erneut:</translation>
        </message>
        <message>
            <source>1 student added, {m} updated</source>
            <translation type="unfinished">1 Teilnehmer hinzugefügt, {m} aktualisiert</translation>
        </message>
        <message>
            <source>{n} students added, {m} updated</source>
            <translation type="unfinished">{n} Teilnehmer hinzugefügt, {m} aktualisiert</translation>
        </message>
        <message>
            <source>Hand these out; they are kept nowhere.</source>
            <translation type="unfinished">Geben Sie sie weiter; sie werden nirgends aufbewahrt.</translation>
        </message>
        <message>
            <source>PINs</source>
            <translation type="unfinished">PINs</translation>
        </message>
        <message>
            <source>Erase</source>
            <translation type="unfinished">Löschen</translation>
        </message>
        <message>
            <source>Erase {name} for good?</source>
            <translation type="unfinished">{name} endgültig löschen?</translation>
        </message>
        <message>
            <source>Name, PIN, groups and comments go, and no backup brings them back. The records of attempts hold a random key only: they can stay as nobody's, or go too.</source>
            <translation type="unfinished">Name, PIN, Gruppen und Kommentare verschwinden, und keine Sicherung bringt sie zurück. Die Aufzeichnungen der Versuche tragen nur einen Zufallsschlüssel: Sie können ohne Person bleiben oder mitgelöscht werden.</translation>
        </message>
        <message>
            <source>Erase, keep the records</source>
            <translation type="unfinished">Löschen, Aufzeichnungen behalten</translation>
        </message>
        <message>
            <source>Erase with all records</source>
            <translation type="unfinished">Mit allen Aufzeichnungen löschen</translation>
        </message>
        <message>
            <source>{name} was erased; records deleted: {n}, kept as nobody's: {m}</source>
            <translation type="unfinished">{name} wurde gelöscht; gelöschte Aufzeichnungen: {n}, ohne Person behalten: {m}</translation>
        </message>
        <message>
            <source>Erasing</source>
            <translation type="unfinished">Wird gelöscht</translation>
        </message>
        <message>
            <source>{id} is already in use: choose another file name</source>
            <translation type="unfinished">{id} wird schon verwendet: Wählen Sie einen anderen Dateinamen</translation>
        </message>
        <message>
            <source>{title} cannot be begun: {why}.</source>
            <translation type="unfinished">{title} kann nicht begonnen werden: {why}.</translation>
        </message>
        <message>
            <source>Release {n} results of {title}?</source>
            <translation type="unfinished">{n} Ergebnisse von {title} freigeben?</translation>
        </message>
        <message>
            <source>Release 1 result of {title}?</source>
            <translation type="unfinished">1 Ergebnis von {title} freigeben?</translation>
        </message>
        <message>
            <source>Release results</source>
            <translation type="unfinished">Ergebnisse freigeben</translation>
        </message>
        <message>
            <source>Their students see score, replay and your comments then. Each can be held back.</source>
            <translation type="unfinished">Die Teilnehmer sehen dann Bewertung, Wiedergabe und Ihre Kommentare. Jedes Ergebnis lässt sich zurückhalten.</translation>
        </message>
        <message>
            <source>Release</source>
            <translation type="unfinished">Freigeben</translation>
        </message>
        <message>
            <source>{n} results released</source>
            <translation type="unfinished">{n} Ergebnisse freigegeben</translation>
        </message>
        <message>
            <source>1 result released</source>
            <translation type="unfinished">1 Ergebnis freigegeben</translation>
        </message>
        <message>
            <source>Choose a student on the board first: click on the row.</source>
            <translation type="unfinished">Wählen Sie zuerst einen Teilnehmer in der Übersicht: Klicken Sie auf die Zeile.</translation>
        </message>
        <message>
            <source>Export results</source>
            <translation type="unfinished">Ergebnisse exportieren</translation>
        </message>
        <message>
            <source>Writing the results</source>
            <translation type="unfinished">Ergebnisse werden geschrieben</translation>
        </message>
        <message>
            <source>Backup of Acus (*.acusbackup)</source>
            <translation type="unfinished">Sicherung von Acus (*.acusbackup)</translation>
        </message>
        <message>
            <source>Back up everything</source>
            <translation type="unfinished">Alles sichern</translation>
        </message>
        <message>
            <source>{n} records saved in {name}</source>
            <translation type="unfinished">In {name} gesicherte Aufzeichnungen: {n}</translation>
        </message>
        <message>
            <source>Not in it: {what}</source>
            <translation type="unfinished">Nicht darin: {what}</translation>
        </message>
        <message>
            <source>Backing up</source>
            <translation type="unfinished">Wird gesichert</translation>
        </message>
        <message>
            <source>It cannot be begun: {why}.</source>
            <translation type="unfinished">Beginn nicht möglich: {why}.</translation>
        </message>
        <message>
            <source>Progress and courses</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source> · {n} void</source>
            <translation type="unfinished"> · {n} ungültig</translation>
        </message>
        <message>
            <source>– ({n} not counted)</source>
            <translation type="unfinished">– (nicht gezählt: {n})</translation>
        </message>
        <message>
            <source>{passed}best {best:.0f}, last {last:.0f}{arrow} · {since}{void}   </source>
            <translation type="unfinished">{passed}Bestwert {best:.0f}, zuletzt {last:.0f}{arrow} · {since}{void}   </translation>
        </message>
        <message>
            <source>just now</source>
            <translation type="unfinished">gerade eben</translation>
        </message>
        <message>
            <source>{n} h ago</source>
            <translation type="unfinished">vor {n} Std.</translation>
        </message>
        <message>
            <source>{n} d ago</source>
            <translation type="unfinished">vor {n} T.</translation>
        </message>
        <message>
            <source>{n} attempts count</source>
            <translation type="unfinished">{n} Versuche zählen</translation>
        </message>
        <message>
            <source>1 attempt counts</source>
            <translation type="unfinished">1 Versuch zählt</translation>
        </message>
        <message>
            <source>trend {trend:+.1f} points a time</source>
            <translation type="unfinished">Trend {trend:+.1f} Punkte pro Versuch</translation>
        </message>
        <message>
            <source>{n} not counted: {why}</source>
            <translation type="unfinished">nicht gezählt: {n}; {why}</translation>
        </message>
        <message>
            <source>Progress</source>
            <translation type="unfinished">Fortschritt</translation>
        </message>
        <message>
            <source>Curve</source>
            <translation type="unfinished">Kurve</translation>
        </message>
        <message>
            <source>Points over the attempts (Enter)</source>
            <translation type="unfinished">Punkte über die Versuche (Eingabe)</translation>
        </message>
        <message>
            <source>Attempts…</source>
            <translation type="unfinished">Versuche…</translation>
        </message>
        <message>
            <source>List them: debrief, replay, remarks (Ctrl+Enter)</source>
            <translation type="unfinished">Auflisten: Nachbesprechung, Wiedergabe, Anmerkungen (Strg+Eingabe)</translation>
        </message>
        <message>
            <source>Form of the results</source>
            <translation type="unfinished">Form der Ergebnisse</translation>
        </message>
        <message>
            <source>Table, a row for each metric (CSV)</source>
            <translation type="unfinished">Tabelle, eine Zeile je Messgröße (CSV)</translation>
        </message>
        <message>
            <source>Table, a row for each student (CSV)</source>
            <translation type="unfinished">Tabelle, eine Zeile je Teilnehmer (CSV)</translation>
        </message>
        <message>
            <source>Gradebook for Moodle (CSV)</source>
            <translation type="unfinished">Bewertungen für Moodle (CSV)</translation>
        </message>
        <message>
            <source>Everything (JSON)</source>
            <translation type="unfinished">Alles (JSON)</translation>
        </message>
        <message>
            <source>Report of the group (PDF)</source>
            <translation type="unfinished">Bericht der Gruppe (PDF)</translation>
        </message>
        <message>
            <source>Report of the student chosen (PDF)</source>
            <translation type="unfinished">Bericht des gewählten Teilnehmers (PDF)</translation>
        </message>
        <message>
            <source>Decimal comma</source>
            <translation type="unfinished">Dezimalkomma</translation>
        </message>
        <message>
            <source>Semicolons and decimal commas: as Excel opens them where the comma is the sign</source>
            <translation type="unfinished">Semikolons und Dezimalkommas: wie Excel sie öffnet, wo das Komma üblich ist</translation>
        </message>
        <message>
            <source>Group</source>
            <translation type="unfinished">Gruppe</translation>
        </message>
        <message>
            <source>Course</source>
            <translation type="unfinished">Kurs</translation>
        </message>
        <message>
            <source>All exercises</source>
            <translation type="unfinished">Alle Übungen</translation>
        </message>
        <message>
            <source>Everybody</source>
            <translation type="unfinished">Alle</translation>
        </message>
        <message>
            <source>Nobody yet: add students, or a roster, on the next tab.</source>
            <translation type="unfinished">Noch niemand: Fügen Sie auf dem nächsten Reiter Teilnehmer oder eine Teilnehmerliste hinzu.</translation>
        </message>
        <message>
            <source>Nothing yet: attempts of students who signed in will appear here.</source>
            <translation type="unfinished">Noch nichts: Hier erscheinen die Versuche angemeldeter Teilnehmer.</translation>
        </message>
        <message>
            <source>Only attempts that may be compared; none of a script or an emulated robot. Double-click a cell for its curve, a student for all attempts.</source>
            <translation type="unfinished">Nur vergleichbare Versuche; keine von einem Skript oder einem emulierten Roboter. Doppelklick auf eine Zelle zeigt die Kurve, auf einen Teilnehmer alle Versuche.</translation>
        </message>
        <message>
            <source>Students</source>
            <translation type="unfinished">Teilnehmer</translation>
        </message>
        <message>
            <source>Add…</source>
            <translation type="unfinished">Hinzufügen…</translation>
        </message>
        <message>
            <source>Roster from CSV…</source>
            <translation type="unfinished">Teilnehmerliste aus CSV…</translation>
        </message>
        <message>
            <source>New PIN</source>
            <translation type="unfinished">Neue PIN</translation>
        </message>
        <message>
            <source>Erase…</source>
            <translation type="unfinished">Löschen…</translation>
        </message>
        <message>
            <source>No students yet. A roster is CSV: pseudonym, name, pin, group.</source>
            <translation type="unfinished">Noch keine Teilnehmer. Eine Teilnehmerliste ist CSV: pseudonym, name, pin, group.</translation>
        </message>
        <message>
            <source>Courses</source>
            <translation type="unfinished">Kurse</translation>
        </message>
        <message>
            <source>Dates</source>
            <translation type="unfinished">Termine</translation>
        </message>
        <message>
            <source>Now</source>
            <translation type="unfinished">Jetzt</translation>
        </message>
        <message>
            <source>Begin</source>
            <translation type="unfinished">Beginnen</translation>
        </message>
        <message>
            <source>New course…</source>
            <translation type="unfinished">Neuer Kurs…</translation>
        </message>
        <message>
            <source>Edit…</source>
            <translation type="unfinished">Bearbeiten…</translation>
        </message>
        <message>
            <source>Release results…</source>
            <translation type="unfinished">Ergebnisse freigeben…</translation>
        </message>
        <message>
            <source>Let students see the results of this course that wait</source>
            <translation type="unfinished">Die Teilnehmer die wartenden Ergebnisse dieses Kurses sehen lassen</translation>
        </message>
        <message>
            <source>everybody</source>
            <translation type="unfinished">alle</translation>
        </message>
        <message>
            <source>, in order</source>
            <translation type="unfinished">, der Reihe nach</translation>
        </message>
        <message>
            <source>{n} results wait for their release</source>
            <translation type="unfinished">Ergebnisse, die auf Freigabe warten: {n}</translation>
        </message>
        <message>
            <source>no exercises yet</source>
            <translation type="unfinished">noch keine Übungen</translation>
        </message>
        <message>
            <source>No courses yet: a course is exercises in order, for groups, with dates.</source>
            <translation type="unfinished">Noch keine Kurse: Ein Kurs besteht aus Übungen in einer Reihenfolge, für Gruppen, mit Terminen.</translation>
        </message>
        <message>
            <source>You take no course. Exercises are on the start page.</source>
            <translation type="unfinished">Sie nehmen an keinem Kurs teil. Übungen finden Sie auf der Startseite.</translation>
        </message>
        <message>
            <source>Begin: {title}</source>
            <translation type="unfinished">Beginnen: {title}</translation>
        </message>
        <message>
            <source>nothing is left to be begun</source>
            <translation type="unfinished">es gibt nichts mehr zu beginnen</translation>
        </message>
        <message>
            <source>Briefing first, then the attempt (Enter)</source>
            <translation type="unfinished">Zuerst die Einweisung, dann der Versuch (Eingabe)</translation>
        </message>
        <message>
            <source>assessment</source>
            <translation type="unfinished">Prüfung</translation>
        </message>
        <message>
            <source>practice</source>
            <translation type="unfinished">Training</translation>
        </message>
        <message>
            <source>any number</source>
            <translation type="unfinished">beliebig viele</translation>
        </message>
        <message>
            <source>{left} of {n} left</source>
            <translation type="unfinished">{left} von {n} übrig</translation>
        </message>
        <message>
            <source>{used} done, any number</source>
            <translation type="unfinished">{used} gemacht, beliebig viele</translation>
        </message>
        <message>
            <source>{a} to {b}</source>
            <translation type="unfinished">{a} bis {b}</translation>
        </message>
        <message>
            <source>from {a}</source>
            <translation type="unfinished">ab {a}</translation>
        </message>
        <message>
            <source>until {b}</source>
            <translation type="unfinished">bis {b}</translation>
        </message>
        <message>
            <source>✔ passed</source>
            <translation type="unfinished">✔ bestanden</translation>
        </message>
        <message>
            <source>best {best:.0f}</source>
            <translation type="unfinished">Bestwert {best:.0f}</translation>
        </message>
        <message>
            <source>result not released</source>
            <translation type="unfinished">Ergebnis nicht freigegeben</translation>
        </message>
        <message>
            <source>▶ next</source>
            <translation type="unfinished">▶ als Nächstes</translation>
        </message>
        <message>
            <source>People</source>
            <translation type="unfinished">Personen</translation>
        </message>
        <message>
            <source>In order: the next opens when the one before was passed</source>
            <translation type="unfinished">Der Reihe nach: Die nächste öffnet sich, wenn die vorige bestanden ist</translation>
        </message>
        <message>
            <source>Exercise to add</source>
            <translation type="unfinished">Übung zum Hinzufügen</translation>
        </message>
        <message>
            <source>Version</source>
            <translation type="unfinished">Version</translation>
        </message>
        <message>
            <source>Opens</source>
            <translation type="unfinished">Öffnet</translation>
        </message>
        <message>
            <source>Closes</source>
            <translation type="unfinished">Schließt</translation>
        </message>
        <message>
            <source>separated by commas; empty: everybody</source>
            <translation type="unfinished">durch Kommas getrennt; leer: alle</translation>
        </message>
        <message>
            <source>File name</source>
            <translation type="unfinished">Dateiname</translation>
        </message>
        <message>
            <source>any</source>
            <translation type="unfinished">beliebig</translation>
        </message>
        <message>
            <source>any day</source>
            <translation type="unfinished">beliebiger Tag</translation>
        </message>
        <message>
            <source>A day as year-month-day, such as 2026-11-30; empty: any</source>
            <translation type="unfinished">Ein Tag als Jahr-Monat-Tag, etwa 2026-11-30; leer: beliebig</translation>
        </message>
        <message>
            <source>there are: {names}</source>
            <translation type="unfinished">es gibt: {names}</translation>
        </message>
        <message>
            <source>there are none yet: add students with their groups first</source>
            <translation type="unfinished">es gibt noch keine: Fügen Sie zuerst Teilnehmer mit ihren Gruppen hinzu</translation>
        </message>
        <message>
            <source>Groups: no student is in {name}; {there}. Empty means everybody.</source>
            <translation type="unfinished">Gruppen: In {name} ist kein Teilnehmer; {there}. Leer bedeutet alle.</translation>
        </message>
        <message>
            <source>{n} attempts that may be compared · ● points, click for the debrief · solid: personal best · dashed: median of the last five</source>
            <translation type="unfinished">Vergleichbare Versuche: {n} · ● Punkte, Klick führt zur Nachbesprechung · durchgezogen: persönlicher Bestwert · gestrichelt: Median der letzten fünf</translation>
        </message>
        <message>
            <source>No attempt that counts yet.</source>
            <translation type="unfinished">Noch kein Versuch, der zählt.</translation>
        </message>
        <message>
            <source>I have written it down</source>
            <translation type="unfinished">Ich habe es aufgeschrieben</translation>
        </message>
        <message>
            <source>It is shown this once only: write it down, tick the box, then close.</source>
            <translation type="unfinished">Es wird nur dieses eine Mal gezeigt: aufschreiben, Kästchen ankreuzen, dann schließen.</translation>
        </message>
        <message>
            <source>page {page} of {pages}</source>
            <translation type="unfinished">Seite {page} von {pages}</translation>
        </message>
        <message>
            <source>Report of a group</source>
            <translation type="unfinished">Bericht einer Gruppe</translation>
        </message>
        <message>
            <source>{n} students, {m} exercises, {k} attempts that count: scored, comparable, by a person, not declared void.</source>
            <translation type="unfinished">Teilnehmer: {n}, Übungen: {m}, Versuche, die zählen: {k} (bewertet, vergleichbar, von einem Menschen, nicht für ungültig erklärt).</translation>
        </message>
        <message>
            <source>No attempt of a student who signed in yet.</source>
            <translation type="unfinished">Noch kein Versuch eines angemeldeten Teilnehmers.</translation>
        </message>
        <message>
            <source>Report of a student</source>
            <translation type="unfinished">Bericht eines Teilnehmers</translation>
        </message>
        <message>
            <source>Group: {groups}</source>
            <translation type="unfinished">Gruppe: {groups}</translation>
        </message>
        <message>
            <source>{kind}, {when}, by Acus {version}</source>
            <translation type="unfinished">{kind}, {when}, von Acus {version}</translation>
        </message>
        <message>
            <source>passed</source>
            <translation type="unfinished">bestanden</translation>
        </message>
        <message>
            <source>{n} of {m}</source>
            <translation type="unfinished">{n} von {m}</translation>
        </message>
        <message>
            <source>Best</source>
            <translation type="unfinished">Bestwert</translation>
        </message>
        <message>
            <source>Last</source>
            <translation type="unfinished">Zuletzt</translation>
        </message>
        <message>
            <source>Trend</source>
            <translation type="unfinished">Trend</translation>
        </message>
        <message>
            <source>Passed</source>
            <translation type="unfinished">Bestanden</translation>
        </message>
        <message>
            <source>not counted: {why}</source>
            <translation type="unfinished">nicht gezählt: {why}</translation>
        </message>
        <message>
            <source>● attempt   — best until then   - - median of five</source>
            <translation type="unfinished">● Versuch   — Bestwert bis dahin   - - Median von fünf</translation>
        </message>
        <message>
            <source>The instructor's remarks</source>
            <translation type="unfinished">Anmerkungen des Kursleiters</translation>
        </message>
        <message>
            <source>Declared void: {why}</source>
            <translation type="unfinished">Für ungültig erklärt: {why}</translation>
        </message>
        <message>
            <source>Save plan</source>
            <translation type="unfinished">Plan speichern</translation>
        </message>
        <message>
            <source>Plans (*{suffix})</source>
            <translation type="unfinished">Pläne (*{suffix})</translation>
        </message>
        <message>
            <source>Unsaved plan</source>
            <translation type="unfinished">Nicht gespeicherter Plan</translation>
        </message>
        <message>
            <source>The plan has unsaved changes. Save them first?</source>
            <translation type="unfinished">Der Plan hat ungespeicherte Änderungen. Zuerst speichern?</translation>
        </message>
        <message>
            <source>Plans (*{suffix} *.json)</source>
            <translation type="unfinished">Pläne (*{suffix} *.json)</translation>
        </message>
        <message>
            <source>Open plan</source>
            <translation type="unfinished">Plan öffnen</translation>
        </message>
        <message>
            <source>Opened {name}</source>
            <translation type="unfinished">{name} geöffnet</translation>
        </message>
        <message>
            <source>● {low:.0f} to 100</source>
            <translation type="unfinished">● {low:.0f} bis 100</translation>
        </message>
        <message>
            <source>● {low:.0f} to {high:.0f}</source>
            <translation type="unfinished">● {low:.0f} bis {high:.0f}</translation>
        </message>
        <message>
            <source>• {low:.0f} to {high:.0f}</source>
            <translation type="unfinished">• {low:.0f} bis {high:.0f}</translation>
        </message>
        <message>
            <source>• below {high:.0f}</source>
            <translation type="unfinished">• unter {high:.0f}</translation>
        </message>
        <message>
            <source>× not possible</source>
            <translation type="unfinished">× nicht möglich</translation>
        </message>
        <message>
            <source>The skin next to your click is {distance:.1f} mm out of the slice you clicked in: the entry lies in another one.</source>
            <translation type="unfinished">Die Haut neben Ihrem Klick liegt {distance:.1f} mm außerhalb der angeklickten Schicht: Der Einstichpunkt liegt in einer anderen.</translation>
        </message>
        <message>
            <source>Place  E</source>
            <translation type="unfinished">Setzen  E</translation>
        </message>
        <message>
            <source>Place  T</source>
            <translation type="unfinished">Setzen  T</translation>
        </message>
        <message>
            <source>Then click near the skin in any view (key E)</source>
            <translation type="unfinished">Klicken Sie dann in einer Ansicht nahe an die Haut (Taste E)</translation>
        </message>
        <message>
            <source>Then click inside the patient in any view (key T)</source>
            <translation type="unfinished">Klicken Sie dann in einer Ansicht in den Patienten (Taste T)</translation>
        </message>
        <message>
            <source>Apply suggested rotation</source>
            <translation type="unfinished">Vorgeschlagene Drehung anwenden</translation>
        </message>
        <message>
            <source>Open…</source>
            <translation type="unfinished">Öffnen…</translation>
        </message>
        <message>
            <source>Save as…</source>
            <translation type="unfinished">Speichern als…</translation>
        </message>
        <message>
            <source>• unsaved changes</source>
            <translation type="unfinished">• ungespeicherte Änderungen</translation>
        </message>
        <message>
            <source>Patient position</source>
            <translation type="unfinished">Patientenlage</translation>
        </message>
        <message>
            <source>Supine (on the back)</source>
            <translation type="unfinished">Rückenlage</translation>
        </message>
        <message>
            <source>Prone (on the belly)</source>
            <translation type="unfinished">Bauchlage</translation>
        </message>
        <message>
            <source>Left side down</source>
            <translation type="unfinished">Linke Seite unten</translation>
        </message>
        <message>
            <source>Right side down</source>
            <translation type="unfinished">Rechte Seite unten</translation>
        </message>
        <message>
            <source>not placed yet</source>
            <translation type="unfinished">noch nicht gesetzt</translation>
        </message>
        <message>
            <source>Free rotation about the robot's {axis} axis (rotation vector)</source>
            <translation type="unfinished">Freie Drehung um die {axis}-Achse des Roboters (Rotationsvektor)</translation>
        </message>
        <message>
            <source>Open plan…</source>
            <translation type="unfinished">Plan öffnen…</translation>
        </message>
        <message>
            <source>Recent plans</source>
            <translation type="unfinished">Letzte Pläne</translation>
        </message>
        <message>
            <source>Save plan as…</source>
            <translation type="unfinished">Plan speichern als…</translation>
        </message>
        <message>
            <source>&amp;Edit</source>
            <translation type="unfinished">&amp;Bearbeiten</translation>
        </message>
        <message>
            <source>Place entry</source>
            <translation type="unfinished">Einstichpunkt setzen</translation>
        </message>
        <message>
            <source>Place target</source>
            <translation type="unfinished">Ziel setzen</translation>
        </message>
        <message>
            <source>the plan “{name}”, which has unsaved changes</source>
            <translation type="unfinished">den Plan „{name}“ mit ungespeicherten Änderungen</translation>
        </message>
        <message>
            <source>Map entries for this target</source>
            <translation type="unfinished">Einstichpunkte für dieses Ziel kartieren</translation>
        </message>
        <message>
            <source>Clear</source>
            <translation type="unfinished">Leeren</translation>
        </message>
        <message>
            <source>Take this path</source>
            <translation type="unfinished">Diesen Pfad nehmen</translation>
        </message>
        <message>
            <source>Scores straight paths to the target from all over the skin: length, angle to the skin, bone, lung, vessels and gut on the way, distance to structures that warn, and the robot's reach.</source>
            <translation type="unfinished">Bewertet gerade Pfade zum Ziel von der ganzen Haut aus: Länge, Winkel zur Haut, Knochen, Lunge, Gefäße und Darm auf dem Weg, Abstand zu Strukturen, die warnen, und die Reichweite des Roboters.</translation>
        </message>
        <message>
            <source>{free} of {all} entries are possible.</source>
            <translation type="unfinished">Mögliche Einstichpunkte: {free} von {all}.</translation>
        </message>
        <message>
            <source>No entry is possible: turn the patient, or choose another target.</source>
            <translation type="unfinished">Kein Einstichpunkt ist möglich: Drehen Sie den Patienten oder wählen Sie ein anderes Ziel.</translation>
        </message>
        <message>
            <source>No structure warns: the scores know tissue and reach only.</source>
            <translation type="unfinished">Keine Struktur warnt: Die Bewertungen kennen nur Gewebe und Reichweite.</translation>
        </message>
        <message>
            <source>Planning help</source>
            <translation type="unfinished">Planungshilfe</translation>
        </message>
        <message>
            <source>Length
[mm]</source>
            <translation type="unfinished">Länge
[mm]</translation>
        </message>
        <message>
            <source>Angle
[°]</source>
            <translation type="unfinished">Winkel
[°]</translation>
        </message>
        <message>
            <source>Nearest
[mm]</source>
            <translation type="unfinished">Nächste
[mm]</translation>
        </message>
        <message>
            <source>Candidate paths</source>
            <translation type="unfinished">Mögliche Pfade</translation>
        </message>
        <message>
            <source>Place the target first (key T)</source>
            <translation type="unfinished">Setzen Sie zuerst das Ziel (Taste T)</translation>
        </message>
        <message>
            <source>The planned path meets: {tissues}.</source>
            <translation type="unfinished">Der geplante Pfad trifft: {tissues}.</translation>
        </message>
        <message>
            <source>Scoring paths</source>
            <translation type="unfinished">Pfade werden bewertet</translation>
        </message>
        <message>
            <source>Import position of the patient (.tfm)…</source>
            <translation type="unfinished">Patientenlage importieren (.tfm)…</translation>
        </message>
        <message>
            <source>Export position of the patient (.tfm)…</source>
            <translation type="unfinished">Patientenlage exportieren (.tfm)…</translation>
        </message>
        <message>
            <source>Export position of the patient</source>
            <translation type="unfinished">Patientenlage exportieren</translation>
        </message>
        <message>
            <source>Import position of the patient</source>
            <translation type="unfinished">Patientenlage importieren</translation>
        </message>
        <message>
            <source>choose an exercise first: its device says where its fulcrum is</source>
            <translation type="unfinished">wählen Sie zuerst eine Übung: Ihr Gerät sagt, wo sein Drehpunkt ist</translation>
        </message>
        <message>
            <source>{name} goes from the patient to the robot; needed is the other direction: invert it in Slicer</source>
            <translation type="unfinished">{name} führt vom Patienten zum Roboter; gebraucht wird die andere Richtung: Kehren Sie die Transformation in Slicer um</translation>
        </message>
        <message>
            <source>Position taken from {name}</source>
            <translation type="unfinished">Lage aus {name} übernommen</translation>
        </message>
        <message>
            <source>Rotation taken from {name}. Its shift would put the robot's fulcrum {off} mm from the entry of this plan and was left out: the entry lies on the fulcrum.</source>
            <translation type="unfinished">Drehung aus {name} übernommen. Die Verschiebung würde den Drehpunkt des Roboters {off} mm neben den Einstichpunkt dieses Plans legen und blieb weg: Der Einstichpunkt liegt auf dem Drehpunkt.</translation>
        </message>
        <message>
            <source>Place the entry on the skin: press E, then click.</source>
            <translation type="unfinished">Setzen Sie den Einstichpunkt auf die Haut: E drücken, dann klicken.</translation>
        </message>
        <message>
            <source>Place the target: press T, then click.</source>
            <translation type="unfinished">Setzen Sie das Ziel: T drücken, dann klicken.</translation>
        </message>
        <message>
            <source>No device chosen yet.</source>
            <translation type="unfinished">Noch kein Gerät gewählt.</translation>
        </message>
        <message>
            <source>Path {length:.1f} mm, tilt {tilt:.1f}° from vertical</source>
            <translation type="unfinished">Pfad {length:.1f} mm, Neigung {tilt:.1f}° zur Senkrechten</translation>
        </message>
        <message>
            <source>Out of reach: {reasons}.</source>
            <translation type="unfinished">Außer Reichweite: {reasons}.</translation>
        </message>
        <message>
            <source>Remedy: {words}</source>
            <translation type="unfinished">Abhilfe: {words}</translation>
        </message>
        <message>
            <source>The robot can follow this path.</source>
            <translation type="unfinished">Der Roboter kann diesem Pfad folgen.</translation>
        </message>
        <message>
            <source>The robot can follow; what lies on the way is being looked up…</source>
            <translation type="unfinished">Der Roboter kann folgen; was auf dem Weg liegt, wird nachgesehen…</translation>
        </message>
        <message>
            <source>What lies on the way is not known: {reason}.</source>
            <translation type="unfinished">Was auf dem Weg liegt, ist nicht bekannt: {reason}.</translation>
        </message>
        <message>
            <source>No bone, lung, vessel, gut or heart is on the way to the target's organ.</source>
            <translation type="unfinished">Auf dem Weg zum Organ des Ziels liegt weder Knochen noch Lunge, Gefäß, Darm oder Herz.</translation>
        </message>
        <message>
            <source>{tissue} on the way at {depth:.0f} mm</source>
            <translation type="unfinished">{tissue} auf dem Weg bei {depth:.0f} mm</translation>
        </message>
        <message>
            <source>perhaps {tissue} on the way at {depth:.0f} mm</source>
            <translation type="unfinished">vielleicht {tissue} auf dem Weg bei {depth:.0f} mm</translation>
        </message>
        <message>
            <source>Finish a plan that the robot can follow first.</source>
            <translation type="unfinished">Stellen Sie zuerst einen Plan fertig, dem der Roboter folgen kann.</translation>
        </message>
        <message>
            <source>the CT has no Hounsfield values</source>
            <translation type="unfinished">das CT hat keine Hounsfield-Werte</translation>
        </message>
        <message>
            <source>Two by two</source>
            <translation type="unfinished">Zwei mal zwei</translation>
        </message>
        <message>
            <source>One large and three</source>
            <translation type="unfinished">Eine große und drei</translation>
        </message>
        <message>
            <source>Six: slices, needle's planes, 3D</source>
            <translation type="unfinished">Sechs: Schichten, Nadelebenen, 3D</translation>
        </message>
        <message>
            <source>Needle: in-plane and probe's-eye</source>
            <translation type="unfinished">Nadel: in der Ebene und Nadelblick</translation>
        </message>
        <message>
            <source>the assistance</source>
            <translation type="unfinished">die Unterstützung</translation>
        </message>
        <message>
            <source>what moves the hand, and how far</source>
            <translation type="unfinished">womit die Hand bewegt wird und wie weit</translation>
        </message>
        <message>
            <source>This is an assessment: {what} is the same for everybody.</source>
            <translation type="unfinished">Dies ist eine Prüfung. Für alle gleich: {what}.</translation>
        </message>
        <message>
            <source>This attempt is a probe, without help: {what} stays as it is.</source>
            <translation type="unfinished">Dieser Versuch ist ein Testversuch, ohne Hilfe. Unverändert bleibt: {what}.</translation>
        </message>
        <message>
            <source>Control scans guide here: {what} stays as the exercise has it.</source>
            <translation type="unfinished">Hier führen Kontrollscans. Wie in der Übung bleibt: {what}.</translation>
        </message>
        <message>
            <source>The exercise “{title}” sets {what}.</source>
            <translation type="unfinished">Die Übung „{title}“ legt fest: {what}.</translation>
        </message>
        <message>
            <source>Needle on the slices</source>
            <translation type="unfinished">Nadel auf den Schichten</translation>
        </message>
        <message>
            <source>Bull's-eye</source>
            <translation type="unfinished">Zielscheibe</translation>
        </message>
        <message>
            <source>3D view</source>
            <translation type="unfinished">3D-Ansicht</translation>
        </message>
        <message>
            <source>Camera pictures</source>
            <translation type="unfinished">Kamerabilder</translation>
        </message>
        <message>
            <source>Force along the needle</source>
            <translation type="unfinished">Kraft entlang der Nadel</translation>
        </message>
        <message>
            <source>Motion of the target</source>
            <translation type="unfinished">Bewegung des Ziels</translation>
        </message>
        <message>
            <source>Not shown in this exercise</source>
            <translation type="unfinished">In dieser Übung nicht gezeigt</translation>
        </message>
        <message>
            <source>Not shown in this exercise; switch it on in View ▸ Shown by the exercise</source>
            <translation type="unfinished">In dieser Übung nicht gezeigt; schalten Sie es ein unter Ansicht ▸ Von der Übung gezeigt</translation>
        </message>
        <message>
            <source>this key is a modifier; take another one</source>
            <translation type="unfinished">diese Taste ist eine Umschalttaste wie Strg; nehmen Sie eine andere</translation>
        </message>
        <message>
            <source>{key} has another meaning in the window; take another one</source>
            <translation type="unfinished">{key} hat im Fenster eine andere Bedeutung; nehmen Sie eine andere</translation>
        </message>
        <message>
            <source>Key for the forces</source>
            <translation type="unfinished">Taste für die Kräfte</translation>
        </message>
        <message>
            <source>Press the key or pedal that shall switch the forces on while it is held. A pedal on USB counts as a keyboard.</source>
            <translation type="unfinished">Drücken Sie die Taste oder das Pedal, das die Kräfte einschalten soll, solange es gehalten wird. Ein USB-Pedal zählt als Tastatur.</translation>
        </message>
        <message>
            <source>&amp;Robot</source>
            <translation type="unfinished">&amp;Roboter</translation>
        </message>
        <message>
            <source>{port} – not plugged in</source>
            <translation type="unfinished">{port} – nicht angeschlossen</translation>
        </message>
        <message>
            <source>Other port</source>
            <translation type="unfinished">Anderer Port</translation>
        </message>
        <message>
            <source>Port of the robot, for example /dev/ttyUSB0, or what `acus device emulate` has printed</source>
            <translation type="unfinished">Port des Roboters, zum Beispiel /dev/ttyUSB0, oder was `acus device emulate` ausgegeben hat</translation>
        </message>
        <message>
            <source>The simulated robot needs no commissioning: choose the robot's port in the menu Robot, Use. `acus device emulate` brings one to practise on.</source>
            <translation type="unfinished">Der simulierte Roboter braucht keine Inbetriebnahme: Wählen Sie den Port des Roboters im Menü Roboter, Verwenden. `acus device emulate` stellt einen zum Üben bereit.</translation>
        </message>
        <message>
            <source>Choose an exercise first: it names the device.</source>
            <translation type="unfinished">Wählen Sie zuerst eine Übung: Sie nennt das Gerät.</translation>
        </message>
        <message>
            <source>Opening the robot</source>
            <translation type="unfinished">Roboter wird geöffnet</translation>
        </message>
        <message>
            <source>Use</source>
            <translation type="unfinished">Verwenden</translation>
        </message>
        <message>
            <source>Robot's health</source>
            <translation type="unfinished">Zustand des Roboters</translation>
        </message>
        <message>
            <source>Commissioning…</source>
            <translation type="unfinished">Inbetriebnahme…</translation>
        </message>
        <message>
            <source>Arm the simulated robot by a held key too</source>
            <translation type="unfinished">Auch den simulierten Roboter mit gehaltener Taste scharf schalten</translation>
        </message>
        <message>
            <source>Energy gauge</source>
            <translation type="unfinished">Energieanzeige</translation>
        </message>
        <message>
            <source>Key for the forces: {key}…</source>
            <translation type="unfinished">Taste für die Kräfte: {key}…</translation>
        </message>
        <message>
            <source>Simulated robot</source>
            <translation type="unfinished">Simulierter Roboter</translation>
        </message>
        <message>
            <source>no other robot is plugged in</source>
            <translation type="unfinished">kein anderer Roboter ist angeschlossen</translation>
        </message>
        <message>
            <source>Other port…</source>
            <translation type="unfinished">Anderer Port…</translation>
        </message>
        <message>
            <source>No robot: pen and webcam…</source>
            <translation type="unfinished">Kein Roboter: Stift und Webcam…</translation>
        </message>
        <message>
            <source>With a real robot, and when the guard acts</source>
            <translation type="unfinished">Mit echtem Roboter, und wenn der Wächter eingreift</translation>
        </message>
        <message>
            <source>Always</source>
            <translation type="unfinished">Immer</translation>
        </message>
        <message>
            <source>Never</source>
            <translation type="unfinished">Nie</translation>
        </message>
        <message>
            <source>Board's error</source>
            <translation type="unfinished">Fehler der Platine</translation>
        </message>
        <message>
            <source>{words} (code {code})</source>
            <translation type="unfinished">{words} (Code {code})</translation>
        </message>
        <message>
            <source>Error that the board reports; docs/protocol.md lists the codes.</source>
            <translation type="unfinished">Fehler, den die Platine meldet; docs/protocol.md nennt die Codes.</translation>
        </message>
        <message>
            <source>{median:.2f} / {p99:.2f} ms</source>
            <translation type="unfinished">{median:.2f} / {p99:.2f} ms</translation>
        </message>
        <message>
            <source>Round trip</source>
            <translation type="unfinished">Umlaufzeit</translation>
        </message>
        <message>
            <source>From command to answer, median / 99th percentile of the last {s:.0f} s.</source>
            <translation type="unfinished">Vom Befehl bis zur Antwort, Median / 99. Perzentil der letzten {s:.0f} s.</translation>
        </message>
        <message>
            <source>Answers</source>
            <translation type="unfinished">Antworten</translation>
        </message>
        <message>
            <source>{replies:.0f}/s · {errors:.1f}/s broken · {lost:.1f}/s lost</source>
            <translation type="unfinished">{replies:.0f}/s · {errors:.1f}/s defekt · {lost:.1f}/s verloren</translation>
        </message>
        <message>
            <source>Answers of the board, frames with a wrong checksum, and commands without an answer, over the last {s:.0f} s; since the start {replies}, {errors}, {lost}. Broken frames: a shorter cable, away from motor leads, a ferrite.</source>
            <translation type="unfinished">Antworten der Platine, Rahmen mit falscher Prüfsumme und Befehle ohne Antwort in den letzten {s:.0f} s; seit dem Start {replies}, {errors}, {lost}. Bei defekten Rahmen: kürzeres Kabel, weg von Motorleitungen, ein Ferrit.</translation>
        </message>
        <message>
            <source>connected</source>
            <translation type="unfinished">verbunden</translation>
        </message>
        <message>
            <source>in memory</source>
            <translation type="unfinished">im Speicher</translation>
        </message>
        <message>
            <source>connecting</source>
            <translation type="unfinished">verbindet</translation>
        </message>
        <message>
            <source>Wait a moment.</source>
            <translation type="unfinished">Warten Sie einen Moment.</translation>
        </message>
        <message>
            <source>Check cable and power; the program keeps looking for the robot.</source>
            <translation type="unfinished">Prüfen Sie Kabel und Strom; das Programm sucht weiter nach dem Roboter.</translation>
        </message>
        <message>
            <source>closed</source>
            <translation type="unfinished">geschlossen</translation>
        </message>
        <message>
            <source>The port is gone: plug the cable in, or choose the robot again.</source>
            <translation type="unfinished">Der Port ist weg: Schließen Sie das Kabel an oder wählen Sie den Roboter erneut.</translation>
        </message>
        <message>
            <source>wrong protocol version</source>
            <translation type="unfinished">falsche Protokollversion</translation>
        </message>
        <message>
            <source>The board speaks another version; load the firmware that fits (docs/protocol.md).</source>
            <translation type="unfinished">Die Platine spricht eine andere Version; laden Sie die passende Firmware (docs/protocol.md).</translation>
        </message>
        <message>
            <source>status {code}</source>
            <translation type="unfinished">Status {code}</translation>
        </message>
        <message>
            <source>Link</source>
            <translation type="unfinished">Verbindung</translation>
        </message>
        <message>
            <source>How the wire to the robot is.</source>
            <translation type="unfinished">Wie es um die Leitung zum Roboter steht.</translation>
        </message>
        <message>
            <source>left {left:.1f}°, right {right:.1f}°</source>
            <translation type="unfinished">links {left:.1f}°, rechts {right:.1f}°</translation>
        </message>
        <message>
            <source>Joints</source>
            <translation type="unfinished">Gelenke</translation>
        </message>
        <message>
            <source>Joint angles now.</source>
            <translation type="unfinished">Jetzige Gelenkwinkel.</translation>
        </message>
        <message>
            <source>Velocity by</source>
            <translation type="unfinished">Geschwindigkeit</translation>
        </message>
        <message>
            <source>How joint velocities are estimated; `acus study velocity` compares the ways.</source>
            <translation type="unfinished">Wie die Gelenkgeschwindigkeiten geschätzt werden; `acus study velocity` vergleicht die Verfahren.</translation>
        </message>
        <message>
            <source>says nothing</source>
            <translation type="unfinished">sagt nichts</translation>
        </message>
        <message>
            <source>The loop has not ticked yet. Wait a moment; if it stays so, start the exercise again.</source>
            <translation type="unfinished">Die Regelschleife hat noch nicht getaktet. Warten Sie einen Moment; bleibt es so, starten Sie die Übung neu.</translation>
        </message>
        <message>
            <source>Force</source>
            <translation type="unfinished">Kraft</translation>
        </message>
        <message>
            <source>Device</source>
            <translation type="unfinished">Gerät</translation>
        </message>
        <message>
            <source>Wire</source>
            <translation type="unfinished">Leitung</translation>
        </message>
        <message>
            <source>Loop</source>
            <translation type="unfinished">Regelschleife</translation>
        </message>
        <message>
            <source>Commissioning</source>
            <translation type="unfinished">Inbetriebnahme</translation>
        </message>
        <message>
            <source>Fault</source>
            <translation type="unfinished">Störung</translation>
        </message>
        <message>
            <source>While there is a fault the robot gives no force. Its message says what to do.</source>
            <translation type="unfinished">Solange eine Störung besteht, gibt der Roboter keine Kraft. Ihre Meldung sagt, was zu tun ist.</translation>
        </message>
        <message>
            <source>Armed</source>
            <translation type="unfinished">Scharf</translation>
        </message>
        <message>
            <source>The force rises from 0 to 100 % within a second after arming, and is off at once.</source>
            <translation type="unfinished">Die Kraft steigt nach dem Scharfschalten binnen einer Sekunde von 0 auf 100 % und ist sofort aus.</translation>
        </message>
        <message>
            <source>Force limit</source>
            <translation type="unfinished">Kraftgrenze</translation>
        </message>
        <message>
            <source>{n:g} N</source>
            <translation type="unfinished">{n:g} N</translation>
        </message>
        <message>
            <source>Largest force at the hand: the device's own limit, nothing holds it lower.</source>
            <translation type="unfinished">Größte Kraft an der Hand: die Grenze des Geräts selbst, nichts hält sie niedriger.</translation>
        </message>
        <message>
            <source>force at {percent:.0f} %</source>
            <translation type="unfinished">Kraft bei {percent:.0f} %</translation>
        </message>
        <message>
            <source>Speed governor</source>
            <translation type="unfinished">Geschwindigkeitsbegrenzer</translation>
        </message>
        <message>
            <source>Weakens the force when the needle moves faster than a hand would move it, and ends it when the needle has been let go.</source>
            <translation type="unfinished">Schwächt die Kraft, wenn sich die Nadel schneller bewegt, als eine Hand sie bewegen würde, und beendet sie, wenn die Nadel losgelassen wurde.</translation>
        </message>
        <message>
            <source>{v:g} m/s, {e:g} mJ</source>
            <translation type="unfinished">{v:g} m/s, {e:g} mJ</translation>
        </message>
        <message>
            <source>Limit when let go</source>
            <translation type="unfinished">Grenze beim Loslassen</translation>
        </message>
        <message>
            <source>{limit} (by default)</source>
            <translation type="unfinished">{limit} (Vorgabe)</translation>
        </message>
        <message>
            <source>What the robot's forces may at most give a needle that is let go. </source>
            <translation type="unfinished">Was die Kräfte des Roboters einer losgelassenen Nadel höchstens mitgeben dürfen. </translation>
        </message>
        <message>
            <source>It is given in the robot's profile.</source>
            <translation type="unfinished">Es steht im Profil des Roboters.</translation>
        </message>
        <message>
            <source>The robot's profile states none (limits.let_go), so it is held to 0.25 m/s.</source>
            <translation type="unfinished">Das Profil des Roboters nennt keine (limits.let_go), daher wird er auf 0,25 m/s gehalten.</translation>
        </message>
        <message>
            <source>Depth is between</source>
            <translation type="unfinished">Tiefe liegt zwischen</translation>
        </message>
        <message>
            <source>{low:.0f} and {high:.0f} mm</source>
            <translation type="unfinished">{low:.0f} und {high:.0f} mm</translation>
        </message>
        <message>
            <source>Force and let-go are limited for every depth in it. An error that is the same in every picture (a needle of another length, a band that has slipped, cameras that were moved) cannot be seen: each millimetre of it makes the force wrong by up to {share:.1f} % here. Measure needle and band with calipers.</source>
            <translation type="unfinished">Kraft und Loslassen sind für jede Tiefe darin begrenzt. Ein Fehler, der in jedem Bild gleich ist (eine Nadel anderer Länge, ein verrutschtes Band, bewegte Kameras), ist nicht zu sehen: Jeder Millimeter davon verfälscht die Kraft hier um bis zu {share:.1f} %. Messen Sie Nadel und Band mit dem Messschieber.</translation>
        </message>
        <message>
            <source>Passivity guard</source>
            <translation type="unfinished">Passivitätswächter</translation>
        </message>
        <message>
            <source>{stored} stored, {tank} of {bound} left, {loss} removed</source>
            <translation type="unfinished">{stored} gespeichert, {tank} von {bound} übrig, {loss} entnommen</translation>
        </message>
        <message>
            <source>real, {port}</source>
            <translation type="unfinished">echt, {port}</translation>
        </message>
        <message>
            <source>simulated</source>
            <translation type="unfinished">simuliert</translation>
        </message>
        <message>
            <source>Device profile, and whether there is a robot of metal. Choose it in the menu Robot.</source>
            <translation type="unfinished">Geräteprofil, und ob es einen Roboter aus Metall gibt. Wählen Sie ihn im Menü Roboter.</translation>
        </message>
        <message>
            <source>no serial number</source>
            <translation type="unfinished">keine Seriennummer</translation>
        </message>
        <message>
            <source>Serial number of the board; calibrations are kept by it.</source>
            <translation type="unfinished">Seriennummer der Platine; nach ihr werden Kalibrierungen aufbewahrt.</translation>
        </message>
        <message>
            <source>Firmware</source>
            <translation type="unfinished">Firmware</translation>
        </message>
        <message>
            <source>{version}, protocol {protocol}</source>
            <translation type="unfinished">{version}, Protokoll {protocol}</translation>
        </message>
        <message>
            <source>Program on the board and the version of the wire protocol that it speaks.</source>
            <translation type="unfinished">Programm auf der Platine und die Version des Leitungsprotokolls, das es spricht.</translation>
        </message>
        <message>
            <source>Power cycle</source>
            <translation type="unfinished">Einschaltung</translation>
        </message>
        <message>
            <source>not numbered</source>
            <translation type="unfinished">nicht nummeriert</translation>
        </message>
        <message>
            <source>How often the board was switched on. Homing and sign check count for one power cycle only.</source>
            <translation type="unfinished">Wie oft die Platine eingeschaltet wurde. Referenzfahrt und Vorzeichenkontrolle gelten nur für eine Einschaltung.</translation>
        </message>
        <message>
            <source>force is {origin}</source>
            <translation type="unfinished">Kraft wird {origin}</translation>
        </message>
        <message>
            <source>Force gauge</source>
            <translation type="unfinished">Kraftmesser</translation>
        </message>
        <message>
            <source>nothing to commission</source>
            <translation type="unfinished">nichts in Betrieb zu nehmen</translation>
        </message>
        <message>
            <source>A simulated robot is homed, its signs are right and its forces are true.</source>
            <translation type="unfinished">Ein simulierter Roboter ist referenziert, seine Vorzeichen stimmen und seine Kräfte sind wahr.</translation>
        </message>
        <message>
            <source>Menu Robot, Commissioning; it is needed each time the robot was switched on.</source>
            <translation type="unfinished">Menü Roboter, Inbetriebnahme; sie ist nach jedem Einschalten des Roboters nötig.</translation>
        </message>
        <message>
            <source>Homed</source>
            <translation type="unfinished">Referenziert</translation>
        </message>
        <message>
            <source>Signs checked</source>
            <translation type="unfinished">Vorzeichen kontrolliert</translation>
        </message>
        <message>
            <source>Whether a commanded newton is a newton on a kitchen scale. Until it is measured on this device, forces stay below 1 N. Menu Robot, Commissioning.</source>
            <translation type="unfinished">Ob ein befohlenes Newton auf einer Küchenwaage ein Newton ist. Solange das an diesem Gerät nicht gemessen ist, bleiben die Kräfte unter 1 N. Menü Roboter, Inbetriebnahme.</translation>
        </message>
        <message>
            <source>Force scale</source>
            <translation type="unfinished">Kraftmaßstab</translation>
        </message>
        <message>
            <source>never measured</source>
            <translation type="unfinished">nie gemessen</translation>
        </message>
        <message>
            <source>{factor:.3f} on {date}</source>
            <translation type="unfinished">{factor:.3f} am {date}</translation>
        </message>
        <message>
            <source>in this power cycle</source>
            <translation type="unfinished">seit dem Einschalten</translation>
        </message>
        <message>
            <source>not since it was switched on</source>
            <translation type="unfinished">nicht seit dem Einschalten</translation>
        </message>
        <message>
            <source>— left  - - right   ±{scale:.3g} {unit}</source>
            <translation type="unfinished">— links  - - rechts   ±{scale:.3g} {unit}</translation>
        </message>
        <message>
            <source>Torque</source>
            <translation type="unfinished">Drehmoment</translation>
        </message>
        <message>
            <source>Copy report</source>
            <translation type="unfinished">Bericht kopieren</translation>
        </message>
        <message>
            <source>Copies everything on this page as plain text</source>
            <translation type="unfinished">Kopiert alles auf dieser Seite als reinen Text</translation>
        </message>
        <message>
            <source>No robot is running: open a patient with a plan.</source>
            <translation type="unfinished">Kein Roboter läuft: Öffnen Sie einen Patienten mit einem Plan.</translation>
        </message>
        <message>
            <source>The robot is starting…</source>
            <translation type="unfinished">Der Roboter startet…</translation>
        </message>
        <message>
            <source>Acus {version}: health of the robot</source>
            <translation type="unfinished">Acus {version}: Zustand des Roboters</translation>
        </message>
        <message>
            <source>Commissioning of {name}</source>
            <translation type="unfinished">Inbetriebnahme von {name}</translation>
        </message>
        <message>
            <source>Connect</source>
            <translation type="unfinished">Verbinden</translation>
        </message>
        <message>
            <source>Summary</source>
            <translation type="unfinished">Zusammenfassung</translation>
        </message>
        <message>
            <source>cancelled, the forces are off</source>
            <translation type="unfinished">abgebrochen, die Kräfte sind aus</translation>
        </message>
        <message>
            <source>Homing</source>
            <translation type="unfinished">Referenzfahrt</translation>
        </message>
        <message>
            <source>The encoders only count. Bringing both links to a known pose tells the program where they are. Needed each time the robot is switched on.</source>
            <translation type="unfinished">Die Encoder zählen nur. Beide Glieder in eine bekannte Stellung zu bringen sagt dem Programm, wo sie sind. Nach jedem Einschalten des Roboters nötig.</translation>
        </message>
        <message>
            <source>The robot gives no force in this step.</source>
            <translation type="unfinished">Der Roboter gibt in diesem Schritt keine Kraft.</translation>
        </message>
        <message>
            <source>Encoder offsets</source>
            <translation type="unfinished">Encoder-Nullpunkte</translation>
        </message>
        <message>
            <source>Finds the encoders' zero with the needle in a jig instead of at the stops.</source>
            <translation type="unfinished">Ermittelt die Nullpunkte der Encoder mit der Nadel in einer Vorrichtung statt an den Anschlägen.</translation>
        </message>
        <message>
            <source>Sign check</source>
            <translation type="unfinished">Vorzeichenkontrolle</translation>
        </message>
        <message>
            <source>Finds out whether each encoder counts the right way and each motor pushes the right joint the right way. A robot with a wrong sign runs away instead of guiding. Needed each time the robot was switched on.</source>
            <translation type="unfinished">Stellt fest, ob jeder Encoder richtig herum zählt und jeder Motor das richtige Gelenk richtig herum bewegt. Ein Roboter mit falschem Vorzeichen läuft davon, statt zu führen. Nach jedem Einschalten des Roboters nötig.</translation>
        </message>
        <message>
            <source>Blunt needle. One hand at the switch of the motor supply. Small pulses.</source>
            <translation type="unfinished">Stumpfe Nadel. Eine Hand am Schalter der Motorversorgung. Kleine Impulse.</translation>
        </message>
        <message>
            <source>Finds out whether a commanded newton is a newton. Until it is measured on this device, forces stay below 1 N.</source>
            <translation type="unfinished">Stellt fest, ob ein befohlenes Newton ein Newton ist. Solange das an diesem Gerät nicht gemessen ist, bleiben die Kräfte unter 1 N.</translation>
        </message>
        <message>
            <source>A kitchen scale that shows grams. The robot pushes with 0.2, 0.5 and 0.9 N.</source>
            <translation type="unfinished">Eine Küchenwaage, die Gramm anzeigt. Der Roboter drückt mit 0,2, 0,5 und 0,9 N.</translation>
        </message>
        <message>
            <source>Measures the round trip of the wire and the time from a torque to the motion. Stiffness that is stable depends on it.</source>
            <translation type="unfinished">Misst die Umlaufzeit der Leitung und die Zeit vom Drehmoment bis zur Bewegung. Davon hängt ab, welche Steifigkeit stabil ist.</translation>
        </message>
        <message>
            <source>Hands off the needle. Small pulses.</source>
            <translation type="unfinished">Hände weg von der Nadel. Kleine Impulse.</translation>
        </message>
        <message>
            <source>Friction</source>
            <translation type="unfinished">Reibung</translation>
        </message>
        <message>
            <source>Measures the torque at which each joint begins to move, and its friction in motion, so that it can be compensated.</source>
            <translation type="unfinished">Misst, bei welchem Drehmoment sich jedes Gelenk zu bewegen beginnt, und seine Reibung in Bewegung, damit sie ausgeglichen werden kann.</translation>
        </message>
        <message>
            <source>Hands off the needle. Slow movements.</source>
            <translation type="unfinished">Hände weg von der Nadel. Langsame Bewegungen.</translation>
        </message>
        <message>
            <source>Calibrates the board's own gauge by weights, so that the force is measured instead of estimated.</source>
            <translation type="unfinished">Kalibriert den eigenen Kraftmesser der Platine mit Gewichten, damit die Kraft gemessen statt geschätzt wird.</translation>
        </message>
        <message>
            <source>Two or more known weights and a thread.</source>
            <translation type="unfinished">Zwei oder mehr bekannte Gewichte und ein Faden.</translation>
        </message>
        <message>
            <source>not done yet</source>
            <translation type="unfinished">noch nicht gemacht</translation>
        </message>
        <message>
            <source>{when}, before it was switched on again</source>
            <translation type="unfinished">{when}, vor dem letzten Einschalten</translation>
        </message>
        <message>
            <source>Profile</source>
            <translation type="unfinished">Profil</translation>
        </message>
        <message>
            <source>simulated, to practise</source>
            <translation type="unfinished">simuliert, zum Üben</translation>
        </message>
        <message>
            <source>real</source>
            <translation type="unfinished">echt</translation>
        </message>
        <message>
            <source>Protocol</source>
            <translation type="unfinished">Protokoll</translation>
        </message>
        <message>
            <source>cleared for {n:g} N at the hand</source>
            <translation type="unfinished">freigegeben für {n:g} N an der Hand</translation>
        </message>
        <message>
            <source>Connected</source>
            <translation type="unfinished">Verbunden</translation>
        </message>
        <message>
            <source>The program's stop is not safety-rated: use a blunt needle, and keep a hand at the switch of the motor supply (docs/hardware.md). Cancel ends every step at once, with the forces off.</source>
            <translation type="unfinished">Der Halt des Programms ist nicht sicherheitsgerichtet: Verwenden Sie eine stumpfe Nadel und behalten Sie eine Hand am Schalter der Motorversorgung (docs/hardware.md). Abbrechen beendet jeden Schritt sofort und schaltet die Kräfte aus.</translation>
        </message>
        <message>
            <source>Confirm</source>
            <translation type="unfinished">Bestätigen</translation>
        </message>
        <message>
            <source>Cancel: forces off</source>
            <translation type="unfinished">Abbrechen: Kräfte aus</translation>
        </message>
        <message>
            <source>Undo the last result</source>
            <translation type="unfinished">Letztes Ergebnis zurücknehmen</translation>
        </message>
        <message>
            <source>running</source>
            <translation type="unfinished">läuft</translation>
        </message>
        <message>
            <source>Begin again</source>
            <translation type="unfinished">Neu beginnen</translation>
        </message>
        <message>
            <source>type the number that the scale shows, such as 51.5</source>
            <translation type="unfinished">geben Sie die Zahl ein, die die Waage anzeigt, etwa 51.5</translation>
        </message>
        <message>
            <source>Reading</source>
            <translation type="unfinished">Ablesung</translation>
        </message>
        <message>
            <source>Lungs</source>
            <translation type="unfinished">Lungen</translation>
        </message>
        <message>
            <source>Liver</source>
            <translation type="unfinished">Leber</translation>
        </message>
        <message>
            <source>Gallbladder</source>
            <translation type="unfinished">Gallenblase</translation>
        </message>
        <message>
            <source>Stomach</source>
            <translation type="unfinished">Magen</translation>
        </message>
        <message>
            <source>Spleen</source>
            <translation type="unfinished">Milz</translation>
        </message>
        <message>
            <source>Kidneys</source>
            <translation type="unfinished">Nieren</translation>
        </message>
        <message>
            <source>Pancreas</source>
            <translation type="unfinished">Pankreas</translation>
        </message>
        <message>
            <source>Arteries</source>
            <translation type="unfinished">Arterien</translation>
        </message>
        <message>
            <source>Veins</source>
            <translation type="unfinished">Venen</translation>
        </message>
        <message>
            <source>Lesion</source>
            <translation type="unfinished">Läsion</translation>
        </message>
        <message>
            <source>Cartilage</source>
            <translation type="unfinished">Knorpel</translation>
        </message>
        <message>
            <source>&amp;View</source>
            <translation type="unfinished">&amp;Ansicht</translation>
        </message>
        <message>
            <source>From the front</source>
            <translation type="unfinished">Von vorn</translation>
        </message>
        <message>
            <source>What is at the patient's right is on the left.</source>
            <translation type="unfinished">Was beim Patienten rechts ist, liegt links.</translation>
        </message>
        <message>
            <source>From behind</source>
            <translation type="unfinished">Von hinten</translation>
        </message>
        <message>
            <source>Onto the back.</source>
            <translation type="unfinished">Auf den Rücken.</translation>
        </message>
        <message>
            <source>From the patient's left</source>
            <translation type="unfinished">Von links (Patient)</translation>
        </message>
        <message>
            <source>The face looks to the left.</source>
            <translation type="unfinished">Das Gesicht blickt nach links.</translation>
        </message>
        <message>
            <source>From the patient's right</source>
            <translation type="unfinished">Von rechts (Patient)</translation>
        </message>
        <message>
            <source>The face looks to the right; Shift+R.</source>
            <translation type="unfinished">Das Gesicht blickt nach rechts; Umschalt+R.</translation>
        </message>
        <message>
            <source>From the head</source>
            <translation type="unfinished">Vom Kopf her</translation>
        </message>
        <message>
            <source>The front is on top.</source>
            <translation type="unfinished">Vorn ist oben.</translation>
        </message>
        <message>
            <source>From the feet</source>
            <translation type="unfinished">Von den Füßen her</translation>
        </message>
        <message>
            <source>The front is on top, as in axial slices.</source>
            <translation type="unfinished">Vorn ist oben, wie in axialen Schichten.</translation>
        </message>
        <message>
            <source>From the needle</source>
            <translation type="unfinished">Von der Nadel aus</translation>
        </message>
        <message>
            <source>Along the needle, or the path: what lies ahead.</source>
            <translation type="unfinished">Entlang der Nadel oder des Pfads: was vorausliegt.</translation>
        </message>
        <message>
            <source>From the operator</source>
            <translation type="unfinished">Vom Bediener aus</translation>
        </message>
        <message>
            <source>From behind the robot, as you stand at it.</source>
            <translation type="unfinished">Von hinter dem Roboter, so wie Sie an ihm stehen.</translation>
        </message>
        <message>
            <source>Whole patient</source>
            <translation type="unfinished">Ganzer Patient</translation>
        </message>
        <message>
            <source>Patient and robot, a little from the side.</source>
            <translation type="unfinished">Patient und Roboter, etwas von der Seite.</translation>
        </message>
        <message>
            <source>From where one looked before.</source>
            <translation type="unfinished">Von dort, von wo man zuvor blickte.</translation>
        </message>
        <message>
            <source>X-ray</source>
            <translation type="unfinished">Röntgen</translation>
        </message>
        <message>
            <source>Needle, path and target before everything, the body faint.</source>
            <translation type="unfinished">Nadel, Pfad und Ziel vor allem, der Körper blass.</translation>
        </message>
        <message>
            <source>Cut along the needle</source>
            <translation type="unfinished">Schnitt entlang der Nadel</translation>
        </message>
        <message>
            <source>What lies before the needle's plane goes; the CT is on the cut.</source>
            <translation type="unfinished">Was vor der Nadelebene liegt, entfällt; auf dem Schnitt ist das CT zu sehen.</translation>
        </message>
        <message>
            <source>Axial, sagittal and coronal slice where they are.</source>
            <translation type="unfinished">Axiale, sagittale und koronare Schicht an ihrem Ort.</translation>
        </message>
        <message>
            <source>Organs</source>
            <translation type="unfinished">Organe</translation>
        </message>
        <message>
            <source>The lungs; of the built-in patient all organs.</source>
            <translation type="unfinished">Die Lungen; beim eingebauten Patienten alle Organe.</translation>
        </message>
        <message>
            <source>Light background</source>
            <translation type="unfinished">Heller Hintergrund</translation>
        </message>
        <message>
            <source>For projectors.</source>
            <translation type="unfinished">Für Projektoren.</translation>
        </message>
        <message>
            <source>Volume rendering</source>
            <translation type="unfinished">Volumendarstellung</translation>
        </message>
        <message>
            <source>Surfaces</source>
            <translation type="unfinished">Oberflächen</translation>
        </message>
        <message>
            <source>Bone</source>
            <translation type="unfinished">Knochen</translation>
        </message>
        <message>
            <source>Lung</source>
            <translation type="unfinished">Lunge</translation>
        </message>
        <message>
            <source>Vessels</source>
            <translation type="unfinished">Gefäße</translation>
        </message>
        <message>
            <source>Volume rendering needs a graphics card; here {driver} draws.</source>
            <translation type="unfinished">Die Volumendarstellung braucht eine Grafikkarte; hier zeichnet {driver}.</translation>
        </message>
        <message>
            <source>nothing yet</source>
            <translation type="unfinished">noch nichts</translation>
        </message>
        <message>
            <source>cable at {force:.0f} N</source>
            <translation type="unfinished">Seil mit {force:.0f} N</translation>
        </message>
        <message>
            <source>dashed: slack cable</source>
            <translation type="unfinished">gestrichelt: schlaffes Seil</translation>
        </message>
        <message>
            <source>body</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>skin</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>organs</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>coarse versions</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>surfaces</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Viewpoint, and what is shown</source>
            <translation type="unfinished">Blickpunkt, und was gezeigt wird</translation>
        </message>
        <message>
            <source>3D view off: {why}</source>
            <translation type="unfinished">3D-Ansicht aus: {why}</translation>
        </message>
        <message>
            <source>Surfaces {percent:.0f} %</source>
            <translation type="unfinished">Oberflächen {percent:.0f} %</translation>
        </message>
        <message>
            <source>x-ray</source>
            <translation type="unfinished">Röntgen</translation>
        </message>
        <message>
            <source>cut along the needle</source>
            <translation type="unfinished">Schnitt entlang der Nadel</translation>
        </message>
        <message>
            <source>with slices</source>
            <translation type="unfinished">mit Schichten</translation>
        </message>
        <message>
            <source>3D</source>
            <translation type="unfinished">3D</translation>
        </message>
        <message>
            <source>and {count} more</source>
            <translation type="unfinished">und {count} weitere</translation>
        </message>
        <message>
            <source>Error 95 %, {scale:.0f}×</source>
            <translation type="unfinished">Fehler 95 %, {scale:.0f}×</translation>
        </message>
        <message>
            <source>Tip error 95 %, true to scale</source>
            <translation type="unfinished">Fehler der Spitze 95 %, maßstäblich</translation>
        </message>
        <message>
            <source>Tip error 95 %, {scale:.0f}× enlarged</source>
            <translation type="unfinished">Fehler der Spitze 95 %, {scale:.0f}× vergrößert</translation>
        </message>
        <message>
            <source>can be used</source>
            <translation type="unfinished">verwendbar</translation>
        </message>
        <message>
            <source>Series of {name}</source>
            <translation type="unfinished">Serien von {name}</translation>
        </message>
        <message>
            <source>{count} other files…</source>
            <translation type="unfinished">Andere Dateien: {count}…</translation>
        </message>
        <message>
            <source>{count} series, none of which can be used as it is</source>
            <translation type="unfinished">Serien: {count}, keine davon ist verwendbar, wie sie ist</translation>
        </message>
        <message>
            <source>{count} series, {usable} of which can be used</source>
            <translation type="unfinished">Serien: {count}, davon verwendbar: {usable}</translation>
        </message>
        <message>
            <source>Import CT into the library</source>
            <translation type="unfinished">CT in die Bibliothek importieren</translation>
        </message>
        <message>
            <source>Looking for CT series</source>
            <translation type="unfinished">CT-Serien werden gesucht</translation>
        </message>
        <message>
            <source>Open CT folder…</source>
            <translation type="unfinished">CT-Ordner öffnen…</translation>
        </message>
        <message>
            <source>Open CT archive or file…</source>
            <translation type="unfinished">CT-Archiv oder -Datei öffnen…</translation>
        </message>
        <message>
            <source>Series of the folder…</source>
            <translation type="unfinished">Serien des Ordners…</translation>
        </message>
        <message>
            <source>Recent CTs</source>
            <translation type="unfinished">Letzte CTs</translation>
        </message>
        <message>
            <source>Library of CTs</source>
            <translation type="unfinished">CT-Bibliothek</translation>
        </message>
        <message>
            <source>Phantom patient</source>
            <translation type="unfinished">Phantompatient</translation>
        </message>
        <message>
            <source>Import CT folder, de-identified…</source>
            <translation type="unfinished">CT-Ordner de-identifiziert importieren…</translation>
        </message>
        <message>
            <source>Import CT archive or file, de-identified…</source>
            <translation type="unfinished">CT-Archiv oder -Datei de-identifiziert importieren…</translation>
        </message>
        <message>
            <source>Reading the pictures</source>
            <translation type="unfinished">Bilder werden gelesen</translation>
        </message>
        <message>
            <source>Importing, de-identified</source>
            <translation type="unfinished">De-identifizierter Import</translation>
        </message>
        <message>
            <source>The files say that there is writing in their pictures: every picture that says so needs a box over it.</source>
            <translation type="unfinished">Die Dateien geben an, dass Schrift in ihren Bildern steht: Jedes Bild, das dies angibt, braucht ein Kästchen darüber.</translation>
        </message>
        <message>
            <source>Taken into the library</source>
            <translation type="unfinished">In die Bibliothek aufgenommen</translation>
        </message>
        <message>
            <source>{label}: all {before} images are in the library already; the {given} given are a part</source>
            <translation type="unfinished">{label}: Alle Bilder ({before}) sind schon in der Bibliothek; die {given} gegebenen sind ein Teil davon</translation>
        </message>
        <message>
            <source>{label}: it was in the library already</source>
            <translation type="unfinished">{label}: war schon in der Bibliothek</translation>
        </message>
        <message>
            <source>{label}: {count} files, de-identified and checked</source>
            <translation type="unfinished">{label}: de-identifizierte, geprüfte Dateien: {count}</translation>
        </message>
        <message>
            <source>; they replace the {before} of them that lay there</source>
            <translation type="unfinished">; ersetzt wurden davon dort vorhandene: {before}</translation>
        </message>
        <message>
            <source>Picture; drag to draw a box over writing</source>
            <translation type="unfinished">Bild; ziehen, um ein Kästchen über Schrift zu zeichnen</translation>
        </message>
        <message>
            <source>Names can be written into the picture itself. Nothing finds them by itself: look through the pictures and drag a box over any writing. What is shown black in a box is black in the library for good; the original stays as it is.</source>
            <translation type="unfinished">Namen können ins Bild selbst geschrieben sein. Von allein findet sie nichts: Sehen Sie die Bilder durch und ziehen Sie ein Kästchen über jede Schrift. Was in einem Kästchen schwarz gezeigt wird, ist in der Bibliothek endgültig schwarz; das Original bleibt, wie es ist.</translation>
        </message>
        <message>
            <source>Look through the pictures for writing. These files hold many pictures each; on such files no boxes can be drawn: do not take them in if there is any.</source>
            <translation type="unfinished">Sehen Sie die Bilder auf Schrift durch. Diese Dateien enthalten je viele Bilder; auf solchen lassen sich keine Kästchen zeichnen: Nehmen Sie sie nicht auf, wenn Schrift darin ist.</translation>
        </message>
        <message>
            <source>all pictures</source>
            <translation type="unfinished">alle Bilder</translation>
        </message>
        <message>
            <source>picture {number}</source>
            <translation type="unfinished">Bild {number}</translation>
        </message>
        <message>
            <source>Look at the pictures before they are imported</source>
            <translation type="unfinished">Bilder vor dem Import ansehen</translation>
        </message>
        <message>
            <source>Brightest of all pictures</source>
            <translation type="unfinished">Hellstes aller Bilder</translation>
        </message>
        <message>
            <source>Import, de-identified</source>
            <translation type="unfinished">De-identifiziert importieren</translation>
        </message>
        <message>
            <source>All values</source>
            <translation type="unfinished">Alle Werte</translation>
        </message>
        <message>
            <source>on all pictures</source>
            <translation type="unfinished">auf allen Bildern</translation>
        </message>
        <message>
            <source>on this picture only</source>
            <translation type="unfinished">nur auf diesem Bild</translation>
        </message>
        <message>
            <source>Picture</source>
            <translation type="unfinished">Bild</translation>
        </message>
        <message>
            <source>Of every pixel the highest value in any picture: writing in one of them shows.</source>
            <translation type="unfinished">Von jedem Pixel der höchste Wert aller Bilder: Schrift in einem davon wird sichtbar.</translation>
        </message>
        <message>
            <source>all {count} at once</source>
            <translation type="unfinished">alle {count} auf einmal</translation>
        </message>
        <message>
            <source>picture {number} of {count}</source>
            <translation type="unfinished">Bild {number} von {count}</translation>
        </message>
        <message>
            <source>Window</source>
            <translation type="unfinished">Fensterung</translation>
        </message>
        <message>
            <source>New boxes</source>
            <translation type="unfinished">Neue Kästchen</translation>
        </message>
        <message>
            <source>Open CT folder</source>
            <translation type="unfinished">CT-Ordner öffnen</translation>
        </message>
        <message>
            <source>CT archives and files</source>
            <translation type="unfinished">CT-Archive und -Dateien</translation>
        </message>
        <message>
            <source>All (*)</source>
            <translation type="unfinished">Alle (*)</translation>
        </message>
        <message>
            <source>Open CT file</source>
            <translation type="unfinished">CT-Datei öffnen</translation>
        </message>
        <message>
            <source>Looking for CT series in {name}</source>
            <translation type="unfinished">CT-Serien werden in {name} gesucht</translation>
        </message>
        <message>
            <source>Preparing the phantom patient</source>
            <translation type="unfinished">Phantompatient wird vorbereitet</translation>
        </message>
        <message>
            <source>Reading CT</source>
            <translation type="unfinished">CT wird gelesen</translation>
        </message>
        <message>
            <source>About Acus</source>
            <translation type="unfinished">Über Acus</translation>
        </message>
        <message>
            <source>Acus {version}</source>
            <translation type="unfinished">Acus {version}</translation>
        </message>
        <message>
            <source>Libraries, as installed (being read):</source>
            <translation type="unfinished">Bibliotheken, wie installiert (werden gelesen):</translation>
        </message>
        <message>
            <source>Libraries, as installed:</source>
            <translation type="unfinished">Bibliotheken, wie installiert:</translation>
        </message>
        <message>
            <source>The libraries cannot be listed: {error}</source>
            <translation type="unfinished">Die Bibliotheken lassen sich nicht auflisten: {error}</translation>
        </message>
        <message>
            <source>Acus is under the Apache License 2.0 (LICENSE, NOTICE).</source>
            <translation type="unfinished">Acus steht unter der Apache-Lizenz 2.0 (LICENSE, NOTICE).</translation>
        </message>
        <message>
            <source>Qt {version} and PySide6 are used under the GNU Lesser General Public License (LGPL), version 3: they lie beside the program as libraries of their own, and you may replace them by versions that you have changed.</source>
            <translation type="unfinished">Qt {version} und PySide6 werden unter der GNU Lesser General Public License (LGPL), Version 3, verwendet: Sie liegen als eigene Bibliotheken neben dem Programm, und Sie dürfen sie durch Versionen ersetzen, die Sie geändert haben.</translation>
        </message>
        <message>
            <source>Library</source>
            <translation type="unfinished">Bibliothek</translation>
        </message>
        <message>
            <source>Licence</source>
            <translation type="unfinished">Lizenz</translation>
        </message>
        <message>
            <source>Report a problem</source>
            <translation type="unfinished">Problem melden</translation>
        </message>
        <message>
            <source>This is all that a report holds: no names, no pictures, no paths. Look through it, say above it what you did and what you expected, and send it to whoever looks after this computer. The program sends nothing by itself.</source>
            <translation type="unfinished">Das ist alles, was ein Bericht enthält: keine Namen, keine Bilder, keine Pfade. Sehen Sie ihn durch, schreiben Sie darüber, was Sie getan und was Sie erwartet haben, und schicken Sie ihn an die Person, die diesen Computer betreut. Das Programm sendet nichts von sich aus.</translation>
        </message>
        <message>
            <source>Copy</source>
            <translation type="unfinished">Kopieren</translation>
        </message>
        <message>
            <source>✔ copied</source>
            <translation type="unfinished">✔ kopiert</translation>
        </message>
        <message>
            <source>Save the report</source>
            <translation type="unfinished">Bericht speichern</translation>
        </message>
        <message>
            <source>✖ not saved: {why}</source>
            <translation type="unfinished">✖ nicht gespeichert: {why}</translation>
        </message>
        <message>
            <source>✔ saved</source>
            <translation type="unfinished">✔ gespeichert</translation>
        </message>
        <message>
            <source>User guide</source>
            <translation type="unfinished">Benutzerhandbuch</translation>
        </message>
        <message>
            <source>The user guide is not installed with this program. In a checkout `make docs` builds it. The page that was asked for is docs/{name}.</source>
            <translation type="unfinished">Das Benutzerhandbuch ist mit diesem Programm nicht installiert. In einem Checkout erzeugt es `make docs`. Die gesuchte Seite ist docs/{name}.</translation>
        </message>
        <message>
            <source>As this computer: {language}</source>
            <translation type="unfinished">Wie dieser Computer: {language}</translation>
        </message>
        <message>
            <source>Language</source>
            <translation type="unfinished">Sprache</translation>
        </message>
        <message>
            <source>An attempt is running: end it before another language is chosen</source>
            <translation type="unfinished">Ein Versuch läuft: Beenden Sie ihn, bevor Sie eine andere Sprache wählen</translation>
        </message>
        <message>
            <source>Details</source>
            <translation type="unfinished">Einzelheiten</translation>
        </message>
        <message>
            <source>Close message</source>
            <translation type="unfinished">Meldung schließen</translation>
        </message>
        <message>
            <source>Something went wrong: {what}</source>
            <translation type="unfinished">Etwas ist schiefgegangen: {what}</translation>
        </message>
        <message>
            <source>&amp;Help</source>
            <translation type="unfinished">&amp;Hilfe</translation>
        </message>
        <message>
            <source>Slices: mouse ({scheme})</source>
            <translation type="unfinished">Schichten: Maus ({scheme})</translation>
        </message>
        <message>
            <source>Slices: keys ({scheme})</source>
            <translation type="unfinished">Schichten: Tasten ({scheme})</translation>
        </message>
        <message>
            <source>window presets, the file's own</source>
            <translation type="unfinished">Fensterungen, die der Datei selbst</translation>
        </message>
        <message>
            <source>place entry, place target: then click in any view, 3D too</source>
            <translation type="unfinished">Einstichpunkt, Ziel setzen: dann in eine Ansicht klicken, auch 3D</translation>
        </message>
        <message>
            <source>Drag a mark</source>
            <translation type="unfinished">Marke ziehen</translation>
        </message>
        <message>
            <source>move it</source>
            <translation type="unfinished">sie verschieben</translation>
        </message>
        <message>
            <source>Esc</source>
            <translation type="unfinished">Esc</translation>
        </message>
        <message>
            <source>stop placing</source>
            <translation type="unfinished">Setzen beenden</translation>
        </message>
        <message>
            <source>undo, redo</source>
            <translation type="unfinished">rückgängig, wiederholen</translation>
        </message>
        <message>
            <source>save plan, save as</source>
            <translation type="unfinished">Plan speichern, speichern als</translation>
        </message>
        <message>
            <source>measure: distance, angle, HU, region</source>
            <translation type="unfinished">messen: Abstand, Winkel, HU, Bereich</translation>
        </message>
        <message>
            <source>pen and webcam: a needle without a robot</source>
            <translation type="unfinished">Stift und Webcam: eine Nadel ohne Roboter</translation>
        </message>
        <message>
            <source>open CT folder, open plan</source>
            <translation type="unfinished">CT-Ordner öffnen, Plan öffnen</translation>
        </message>
        <message>
            <source>Left, middle, right drag</source>
            <translation type="unfinished">Links, Mitte, rechts ziehen</translation>
        </message>
        <message>
            <source>who sits here: student, instructor, technician</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>turn, pan, zoom</source>
            <translation type="unfinished">drehen, verschieben, zoomen</translation>
        </message>
        <message>
            <source>look from that side</source>
            <translation type="unfinished">von dieser Seite blicken</translation>
        </message>
        <message>
            <source>look along the needle, as the operator</source>
            <translation type="unfinished">entlang der Nadel blicken, wie der Bediener</translation>
        </message>
        <message>
            <source>Space, r; Backspace</source>
            <translation type="unfinished">Leertaste, r; Rücktaste</translation>
        </message>
        <message>
            <source>whole patient; from where one looked before</source>
            <translation type="unfinished">ganzer Patient; von wo man zuvor blickte</translation>
        </message>
        <message>
            <source>x-ray; cut along the needle</source>
            <translation type="unfinished">Röntgen; Schnitt entlang der Nadel</translation>
        </message>
        <message>
            <source>slices as planes; organs</source>
            <translation type="unfinished">Schichten als Ebenen; Organe</translation>
        </message>
        <message>
            <source>volume rendering; light background</source>
            <translation type="unfinished">Volumendarstellung; heller Hintergrund</translation>
        </message>
        <message>
            <source>Attempt</source>
            <translation type="unfinished">Versuch</translation>
        </message>
        <message>
            <source>start the attempt; anything new is explained first</source>
            <translation type="unfinished">Versuch starten; alles Neue wird zuerst erklärt</translation>
        </message>
        <message>
            <source>briefing; an expert shows it</source>
            <translation type="unfinished">Einweisung; ein Experte zeigt es</translation>
        </message>
        <message>
            <source>control scan</source>
            <translation type="unfinished">Kontrollscan</translation>
        </message>
        <message>
            <source>Enter</source>
            <translation type="unfinished">Eingabe</translation>
        </message>
        <message>
            <source>end the attempt</source>
            <translation type="unfinished">Versuch beenden</translation>
        </message>
        <message>
            <source>in an attempt: all panels; live pictures or the scan</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Hold Esc</source>
            <translation type="unfinished">Esc halten</translation>
        </message>
        <message>
            <source>abort: force to zero at once</source>
            <translation type="unfinished">abbrechen: Kraft sofort auf null</translation>
        </message>
        <message>
            <source>Hold H, or a pedal</source>
            <translation type="unfinished">H oder ein Pedal halten</translation>
        </message>
        <message>
            <source>forces on, where they are armed by holding</source>
            <translation type="unfinished">Kräfte an, wo sie durch Halten scharf geschaltet werden</translation>
        </message>
        <message>
            <source>slices follow the tip; bull's-eye</source>
            <translation type="unfinished">Schichten folgen der Spitze; Zielscheibe</translation>
        </message>
        <message>
            <source>Drag, Q, E in the bull's-eye</source>
            <translation type="unfinished">Ziehen, Q, E in der Zielscheibe</translation>
        </message>
        <message>
            <source>tilt the needle; turn a bevelled one</source>
            <translation type="unfinished">Nadel neigen; eine mit Schliff drehen</translation>
        </message>
        <message>
            <source>Wheel, Page keys in the bull's-eye</source>
            <translation type="unfinished">Mausrad, Bild-Tasten in der Zielscheibe</translation>
        </message>
        <message>
            <source>depth 1 mm, with Shift 0.2 mm</source>
            <translation type="unfinished">Tiefe 1 mm, mit Umschalt 0,2 mm</translation>
        </message>
        <message>
            <source>Keys and mouse</source>
            <translation type="unfinished">Tasten und Maus</translation>
        </message>
        <message>
            <source>next</source>
            <translation type="unfinished">als Nächstes</translation>
        </message>
        <message>
            <source>Search exercises</source>
            <translation type="unfinished">Übungen suchen</translation>
        </message>
        <message>
            <source>Begin exercise</source>
            <translation type="unfinished">Übung beginnen</translation>
        </message>
        <message>
            <source>Exercises</source>
            <translation type="unfinished">Übungen</translation>
        </message>
        <message>
            <source>Three-minute tour</source>
            <translation type="unfinished">Dreiminütiger Rundgang</translation>
        </message>
        <message>
            <source>Not now</source>
            <translation type="unfinished">Nicht jetzt</translation>
        </message>
        <message>
            <source>done {n}</source>
            <translation type="unfinished">gemacht: {n}</translation>
        </message>
        <message>
            <source>best {points}</source>
            <translation type="unfinished">Bestwert {points}</translation>
        </message>
        <message>
            <source>No exercise holds these words: clear the search to see all.</source>
            <translation type="unfinished">Keine Übung enthält diese Wörter: Leeren Sie die Suche, um alle zu sehen.</translation>
        </message>
        <message>
            <source>No exercises found.</source>
            <translation type="unfinished">Keine Übungen gefunden.</translation>
        </message>
        <message>
            <source>CT-guided needle insertion, practised by hand</source>
            <translation type="unfinished">CT-gesteuerte Punktion, von Hand geübt</translation>
        </message>
        <message>
            <source>First time here?</source>
            <translation type="unfinished">Zum ersten Mal hier?</translation>
        </message>
        <message>
            <source>Your own CT</source>
            <translation type="unfinished">Ihr eigenes CT</translation>
        </message>
        <message>
            <source>CTs that you open are listed here: File ▸ Open CT folder…</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>any name: your progress is kept under it</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Your name</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>You practise as</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Difficulty</source>
            <translation type="unfinished">Schwierigkeit</translation>
        </message>
        <message>
            <source>Done</source>
            <translation type="unfinished">Gemacht</translation>
        </message>
        <message>
            <source>Done and best: everybody at this station. Sign in to see your own.</source>
            <translation type="unfinished">Gemacht und Bestwert: von allen an dieser Station. Melden Sie sich an, um Ihre zu sehen.</translation>
        </message>
        <message>
            <source>Done and best: {name}.</source>
            <translation type="unfinished">Gemacht und Bestwert: {name}.</translation>
        </message>
        <message>
            <source>Done and best: everybody at this station.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Sign in as a student to see what you have done.</source>
            <translation type="unfinished">Melden Sie sich als Teilnehmer an, um zu sehen, was Sie gemacht haben.</translation>
        </message>
        <message>
            <source>Next (Enter)</source>
            <translation type="unfinished">Weiter (Eingabe)</translation>
        </message>
        <message>
            <source>Leave (Esc)</source>
            <translation type="unfinished">Verlassen (Esc)</translation>
        </message>
        <message>
            <source>Done (Enter)</source>
            <translation type="unfinished">Fertig (Eingabe)</translation>
        </message>
        <message>
            <source>The patient</source>
            <translation type="unfinished">Der Patient</translation>
        </message>
        <message>
            <source>Every exercise has its patient: a CT and, mostly, a planned path from the entry on the skin to the target. Enter begins: first a briefing, then the attempt. Difficulty rises downwards.</source>
            <translation type="unfinished">Jede Übung hat ihren Patienten: ein CT und meist einen geplanten Pfad vom Einstichpunkt auf der Haut zum Ziel. Eingabe beginnt: zuerst eine Einweisung, dann der Versuch. Die Schwierigkeit nimmt nach unten zu.</translation>
        </message>
        <message>
            <source>The slices</source>
            <translation type="unfinished">Die Schichten</translation>
        </message>
        <message>
            <source>The CT in axial, sagittal and coronal slices, with the plan and, where the exercise shows it, the live needle. The wheel leafs through them, a click moves the cross, the right button changes the window. The 3D view is below.</source>
            <translation type="unfinished">Das CT in axialen, sagittalen und koronaren Schichten, mit dem Plan und, wo die Übung sie zeigt, der Nadel in Bewegung. Das Mausrad blättert, ein Klick versetzt das Kreuz, die rechte Taste ändert die Fensterung. Die 3D-Ansicht ist darunter.</translation>
        </message>
        <message>
            <source>The bull's-eye</source>
            <translation type="unfinished">Die Zielscheibe</translation>
        </message>
        <message>
            <source>The main instrument: how the needle points against the path, and how deep it is. Bring the mark into the middle, then push to the target. During an attempt one line above always says the next step.</source>
            <translation type="unfinished">Das wichtigste Instrument: wie die Nadel zum Pfad steht und wie tief sie ist. Bringen Sie die Marke in die Mitte, schieben Sie dann bis zum Ziel vor. Während eines Versuchs nennt eine Zeile darüber stets den nächsten Schritt.</translation>
        </message>
        <message>
            <source>The hand</source>
            <translation type="unfinished">Die Hand</translation>
        </message>
        <message>
            <source>Without a robot the mouse is the hand: drag in the bull's-eye to tilt, turn the wheel to push or pull. A tablet or a gamepad can take its place. With a robot you hold the needle itself.</source>
            <translation type="unfinished">Ohne Roboter ist die Maus die Hand: Ziehen in der Zielscheibe neigt, das Mausrad schiebt vor oder zieht zurück. Ein Tablett oder ein Gamepad kann sie ersetzen. Mit einem Roboter halten Sie die Nadel selbst.</translation>
        </message>
        <message>
            <source>The robot</source>
            <translation type="unfinished">Der Roboter</translation>
        </message>
        <message>
            <source>Whether robot, cameras and recording are well. As long as nothing here is yellow or red you need not look; a click says more. Holding Esc takes all force off at once, whenever you like.</source>
            <translation type="unfinished">Ob Roboter, Kameras und Aufzeichnung in Ordnung sind. Solange hier nichts gelb oder rot ist, brauchen Sie nicht hinzusehen; ein Klick sagt mehr. Esc halten nimmt sofort alle Kraft weg, wann immer Sie wollen.</translation>
        </message>
        <message>
            <source>The debrief</source>
            <translation type="unfinished">Die Nachbesprechung</translation>
        </message>
        <message>
            <source>When you end the attempt (Enter) it is scored at once: where the needle ended, what cost points and what to do otherwise, everything to be replayed, and which exercise comes next. All attempts stay in Past sessions (F7).</source>
            <translation type="unfinished">Wenn Sie den Versuch beenden (Eingabe), wird er sofort bewertet: wo die Nadel endete, was Punkte gekostet hat und was Sie anders machen können, alles zum Wiedergeben, und welche Übung als Nächstes kommt. Alle Versuche bleiben unter Frühere Sitzungen (F7).</translation>
        </message>
        <message>
            <source>Layout</source>
            <translation type="unfinished">Anordnung</translation>
        </message>
        <message>
            <source>Window presets</source>
            <translation type="unfinished">Fensterungen</translation>
        </message>
        <message>
            <source>One window for all panes</source>
            <translation type="unfinished">Eine Fensterung für alle Ansichten</translation>
        </message>
        <message>
            <source>Lock window and level</source>
            <translation type="unfinished">Fensterung sperren</translation>
        </message>
        <message>
            <source>Invert grey</source>
            <translation type="unfinished">Grauwerte umkehren</translation>
        </message>
        <message>
            <source>Slices follow the needle tip</source>
            <translation type="unfinished">Schichten folgen der Nadelspitze</translation>
        </message>
        <message>
            <source>Bull's-eye beside the slices</source>
            <translation type="unfinished">Zielscheibe neben den Schichten</translation>
        </message>
        <message>
            <source>Legend of the bull's-eye</source>
            <translation type="unfinished">Legende der Zielscheibe</translation>
        </message>
        <message>
            <source>The hand moves the hub, not the tip</source>
            <translation type="unfinished">Die Hand bewegt den Ansatz, nicht die Spitze</translation>
        </message>
        <message>
            <source>Shown by the exercise</source>
            <translation type="unfinished">Von der Übung gezeigt</translation>
        </message>
        <message>
            <source>Crosshair to target</source>
            <translation type="unfinished">Fadenkreuz aufs Ziel</translation>
        </message>
        <message>
            <source>Needle's planes</source>
            <translation type="unfinished">Nadelebenen</translation>
        </message>
        <message>
            <source>Straighten all planes</source>
            <translation type="unfinished">Alle Ebenen gerade richten</translation>
        </message>
        <message>
            <source>Operator's side</source>
            <translation type="unfinished">Seite des Bedieners</translation>
        </message>
        <message>
            <source>Mouse and keys</source>
            <translation type="unfinished">Maus und Tasten</translation>
        </message>
        <message>
            <source>Projector</source>
            <translation type="unfinished">Projektor</translation>
        </message>
        <message>
            <source>Projector mode: all three</source>
            <translation type="unfinished">Projektormodus: alle drei</translation>
        </message>
        <message>
            <source>Light colours</source>
            <translation type="unfinished">Helle Farben</translation>
        </message>
        <message>
            <source>Large text</source>
            <translation type="unfinished">Großer Text</translation>
        </message>
        <message>
            <source>Hide names</source>
            <translation type="unfinished">Namen verbergen</translation>
        </message>
        <message>
            <source>Full screen</source>
            <translation type="unfinished">Vollbild</translation>
        </message>
        <message>
            <source>Left-handed: panel on the right</source>
            <translation type="unfinished">Für Linkshänder: Bereich rechts</translation>
        </message>
        <message>
            <source>As in {scheme}</source>
            <translation type="unfinished">Wie in {scheme}</translation>
        </message>
        <message>
            <source>Level the other way round</source>
            <translation type="unfinished">Fenstermitte andersherum</translation>
        </message>
        <message>
            <source>A file of your own cannot be used: {why}</source>
            <translation type="unfinished">Eine eigene Datei ist nicht verwendbar: {why}</translation>
        </message>
        <message>
            <source>A folder of plug-ins cannot be used: {why}</source>
            <translation type="unfinished">Ein Ordner mit Plug-ins ist nicht verwendbar: {why}</translation>
        </message>
        <message>
            <source>the CT {name}</source>
            <translation type="unfinished">das CT {name}</translation>
        </message>
        <message>
            <source>the attempt that is running: it ends and is saved, without a score</source>
            <translation type="unfinished">den laufenden Versuch: Er endet und wird gespeichert, ohne Bewertung</translation>
        </message>
        <message>
            <source>Opening a patient replaces:</source>
            <translation type="unfinished">Das Öffnen eines Patienten ersetzt:</translation>
        </message>
        <message>
            <source>Save the plan first?</source>
            <translation type="unfinished">Zuerst den Plan speichern?</translation>
        </message>
        <message>
            <source>Open another patient</source>
            <translation type="unfinished">Anderen Patienten öffnen</translation>
        </message>
        <message>
            <source>Start waits: another patient is being opened.</source>
            <translation type="unfinished">Der Start wartet: Ein anderer Patient wird geöffnet.</translation>
        </message>
        <message>
            <source>signed in as the instructor</source>
            <translation type="unfinished">als Kursleiter angemeldet</translation>
        </message>
        <message>
            <source>Start page</source>
            <translation type="unfinished">Startseite</translation>
        </message>
        <message>
            <source>Workspace</source>
            <translation type="unfinished">Arbeitsplatz</translation>
        </message>
        <message>
            <source>Help on this part</source>
            <translation type="unfinished">Hilfe zu diesem Teil</translation>
        </message>
        <message>
            <source>Report a problem…</source>
            <translation type="unfinished">Problem melden…</translation>
        </message>
        <message>
            <source>one slice on, back</source>
            <translation type="unfinished">eine Schicht vor, zurück</translation>
        </message>
        <message>
            <source>ten slices on, back</source>
            <translation type="unfinished">zehn Schichten vor, zurück</translation>
        </message>
        <message>
            <source>first, last slice</source>
            <translation type="unfinished">erste, letzte Schicht</translation>
        </message>
        <message>
            <source>zoom in, out</source>
            <translation type="unfinished">vergrößern, verkleinern</translation>
        </message>
        <message>
            <source>fit to pane</source>
            <translation type="unfinished">in die Ansicht einpassen</translation>
        </message>
        <message>
            <source>reset zoom, window and slab</source>
            <translation type="unfinished">Zoom, Fensterung und Slab zurücksetzen</translation>
        </message>
        <message>
            <source>left drag zooms, until Esc</source>
            <translation type="unfinished">links ziehen zoomt, bis Esc</translation>
        </message>
        <message>
            <source>invert grey</source>
            <translation type="unfinished">Grauwerte umkehren</translation>
        </message>
        <message>
            <source>turn right, left by 90°</source>
            <translation type="unfinished">um 90° nach rechts, links drehen</translation>
        </message>
        <message>
            <source>mirror left-right, top-bottom</source>
            <translation type="unfinished">spiegeln: links-rechts, oben-unten</translation>
        </message>
        <message>
            <source>slab thinner, thicker</source>
            <translation type="unfinished">Slab dünner, dicker</translation>
        </message>
        <message>
            <source>slab: mean, MIP, MinIP</source>
            <translation type="unfinished">Slab: Mittel, MIP, MinIP</translation>
        </message>
        <message>
            <source>cine: start, stop</source>
            <translation type="unfinished">Cine: Start, Stopp</translation>
        </message>
        <message>
            <source>maximise or restore the pane</source>
            <translation type="unfinished">Ansicht maximieren oder wiederherstellen</translation>
        </message>
        <message>
            <source>previous, next pane</source>
            <translation type="unfinished">vorige, nächste Ansicht</translation>
        </message>
        <message>
            <source>move the crosshair</source>
            <translation type="unfinished">Fadenkreuz bewegen</translation>
        </message>
        <message>
            <source>with E or T before: place at the crosshair</source>
            <translation type="unfinished">nach E oder T: am Fadenkreuz setzen</translation>
        </message>
        <message>
            <source>menu of the pane</source>
            <translation type="unfinished">Menü der Ansicht</translation>
        </message>
        <message>
            <source>stop the current action</source>
            <translation type="unfinished">laufende Aktion beenden</translation>
        </message>
        <message>
            <source>up</source>
            <translation type="unfinished">oben</translation>
        </message>
        <message>
            <source>down</source>
            <translation type="unfinished">unten</translation>
        </message>
        <message>
            <source>window (right: wider) and level ({way}: higher)</source>
            <translation type="unfinished">Fensterbreite (rechts: breiter) und Fenstermitte ({way}: höher)</translation>
        </message>
        <message>
            <source>pan</source>
            <translation type="unfinished">verschieben</translation>
        </message>
        <message>
            <source>zoom</source>
            <translation type="unfinished">zoomen</translation>
        </message>
        <message>
            <source>crosshair in all views</source>
            <translation type="unfinished">Fadenkreuz in allen Ansichten</translation>
        </message>
        <message>
            <source>best window for the box</source>
            <translation type="unfinished">beste Fensterung für den Kasten</translation>
        </message>
        <message>
            <source>scroll through slices</source>
            <translation type="unfinished">durch die Schichten blättern</translation>
        </message>
        <message>
            <source>Wheel</source>
            <translation type="unfinished">Mausrad</translation>
        </message>
        <message>
            <source>Shift+move</source>
            <translation type="unfinished">Umschalt+Bewegen</translation>
        </message>
        <message>
            <source>Right click</source>
            <translation type="unfinished">Rechtsklick</translation>
        </message>
        <message>
            <source>menu: windows, slab, turn, cine</source>
            <translation type="unfinished">Menü: Fensterungen, Slab, Drehen, Cine</translation>
        </message>
        <message>
            <source>Double click</source>
            <translation type="unfinished">Doppelklick</translation>
        </message>
        <message>
            <source>maximise or restore a pane</source>
            <translation type="unfinished">eine Ansicht maximieren oder wiederherstellen</translation>
        </message>
        <message>
            <source>Ctrl+double click</source>
            <translation type="unfinished">Strg+Doppelklick</translation>
        </message>
        <message>
            <source>reset window and level</source>
            <translation type="unfinished">Fensterung zurücksetzen</translation>
        </message>
        <message>
            <source>Left drag</source>
            <translation type="unfinished">Links ziehen</translation>
        </message>
        <message>
            <source>Middle drag</source>
            <translation type="unfinished">Mitte ziehen</translation>
        </message>
        <message>
            <source>Right drag</source>
            <translation type="unfinished">Rechts ziehen</translation>
        </message>
        <message>
            <source>Target, TRE 95 %</source>
            <translation type="unfinished">Ziel, TRE 95 %</translation>
        </message>
        <message>
            <source>Target {n}</source>
            <translation type="unfinished">Ziel {n}</translation>
        </message>
        <message>
            <source>not tracked</source>
            <translation type="unfinished">nicht verfolgt</translation>
        </message>
        <message>
            <source>{distance:.0f} mm {side}</source>
            <translation type="unfinished">{distance:.0f} mm {side}</translation>
        </message>
        <message>
            <source>no needle, no path</source>
            <translation type="unfinished">keine Nadel, kein Pfad</translation>
        </message>
        <message>
            <source>through two points</source>
            <translation type="unfinished">durch zwei Punkte</translation>
        </message>
        <message>
            <source>planned path</source>
            <translation type="unfinished">geplanter Pfad</translation>
        </message>
        <message>
            <source>follows the needle</source>
            <translation type="unfinished">folgt der Nadel</translation>
        </message>
        <message>
            <source>Follow the needle</source>
            <translation type="unfinished">Der Nadel folgen</translation>
        </message>
        <message>
            <source>Hold here</source>
            <translation type="unfinished">Hier festhalten</translation>
        </message>
        <message>
            <source>Along the planned path</source>
            <translation type="unfinished">Entlang des geplanten Pfads</translation>
        </message>
        <message>
            <source>Through two points…</source>
            <translation type="unfinished">Durch zwei Punkte…</translation>
        </message>
        <message>
            <source>Lines in the patient views</source>
            <translation type="unfinished">Linien in den Patientenansichten</translation>
        </message>
        <message>
            <source>Keep this window…</source>
            <translation type="unfinished">Fensterung behalten…</translation>
        </message>
        <message>
            <source>Forget a kept window</source>
            <translation type="unfinished">Behaltene Fensterung verwerfen</translation>
        </message>
        <message>
            <source>Turn and mirror</source>
            <translation type="unfinished">Drehen und spiegeln</translation>
        </message>
        <message>
            <source>Cine</source>
            <translation type="unfinished">Cine</translation>
        </message>
        <message>
            <source>Run through the slices</source>
            <translation type="unfinished">Durch die Schichten laufen</translation>
        </message>
        <message>
            <source>{rate} slices a second</source>
            <translation type="unfinished">{rate} Schichten je Sekunde</translation>
        </message>
        <message>
            <source>Fit to pane</source>
            <translation type="unfinished">In die Ansicht einpassen</translation>
        </message>
        <message>
            <source>Reset view</source>
            <translation type="unfinished">Zurücksetzen</translation>
        </message>
        <message>
            <source>Space</source>
            <translation type="unfinished">Leer</translation>
        </message>
        <message>
            <source>Maximise or restore</source>
            <translation type="unfinished">Maximieren oder zurück</translation>
        </message>
        <message>
            <source>{thickness:g} mm</source>
            <translation type="unfinished">{thickness:g} mm</translation>
        </message>
        <message>
            <source>One slice</source>
            <translation type="unfinished">Eine Schicht</translation>
        </message>
        <message>
            <source>Right by 90°</source>
            <translation type="unfinished">Rechts um 90°</translation>
        </message>
        <message>
            <source>Left by 90°</source>
            <translation type="unfinished">Links um 90°</translation>
        </message>
        <message>
            <source>By 180°: from the other side of the table</source>
            <translation type="unfinished">Um 180°: von der anderen Seite des Tisches</translation>
        </message>
        <message>
            <source>Mirror left-right</source>
            <translation type="unfinished">Links-rechts spiegeln</translation>
        </message>
        <message>
            <source>Mirror top-bottom</source>
            <translation type="unfinished">Oben-unten spiegeln</translation>
        </message>
        <message>
            <source>As radiologists read it</source>
            <translation type="unfinished">Wie Radiologen es lesen</translation>
        </message>
        <message>
            <source>Keep this window</source>
            <translation type="unfinished">Fensterung behalten</translation>
        </message>
        <message>
            <source>Name for W {width:.0f}  L {level:.0f}</source>
            <translation type="unfinished">Name für W {width:.0f}  L {level:.0f}</translation>
        </message>
        <message>
            <source>In plane 90°</source>
            <translation type="unfinished">In der Ebene 90°</translation>
        </message>
        <message>
            <source>Probe's eye</source>
            <translation type="unfinished">Nadelblick</translation>
        </message>
        <message>
            <source>{kind} {thickness:g} mm</source>
            <translation type="unfinished">{kind} {thickness:g} mm</translation>
        </message>
        <message>
            <source>mirrored</source>
            <translation type="unfinished">gespiegelt</translation>
        </message>
        <message>
            <source>turned {angle}°</source>
            <translation type="unfinished">gedreht um {angle}°</translation>
        </message>
        <message>
            <source>MIP</source>
            <translation type="unfinished">MIP</translation>
        </message>
        <message>
            <source>MinIP</source>
            <translation type="unfinished">MinIP</translation>
        </message>
        <message>
            <source>At the patient's feet</source>
            <translation type="unfinished">An den Füßen des Patienten</translation>
        </message>
        <message>
            <source>At the patient's head</source>
            <translation type="unfinished">Am Kopf des Patienten</translation>
        </message>
        <message>
            <source>On the patient's right</source>
            <translation type="unfinished">Rechts vom Patienten</translation>
        </message>
        <message>
            <source>On the patient's left</source>
            <translation type="unfinished">Links vom Patienten</translation>
        </message>
        <message>
            <source>Soft tissue</source>
            <translation type="unfinished">Weichteile</translation>
        </message>
        <message>
            <source>Mediastinum</source>
            <translation type="unfinished">Mediastinum</translation>
        </message>
        <message>
            <source>Brain</source>
            <translation type="unfinished">Gehirn</translation>
        </message>
        <message>
            <source>Angio</source>
            <translation type="unfinished">Angio</translation>
        </message>
        <message>
            <source>Spine</source>
            <translation type="unfinished">Wirbelsäule</translation>
        </message>
        <message>
            <source>From values</source>
            <translation type="unfinished">Aus Werten</translation>
        </message>
        <message>
            <source>From DICOM</source>
            <translation type="unfinished">Aus DICOM</translation>
        </message>
        <message>
            <source>the target</source>
            <translation type="unfinished">dem Ziel</translation>
        </message>
        <message>
            <source>the 2nd point</source>
            <translation type="unfinished">dem 2. Punkt</translation>
        </message>
        <message>
            <source>the tip</source>
            <translation type="unfinished">der Spitze</translation>
        </message>
        <message>
            <source>the path</source>
            <translation type="unfinished">den Pfad</translation>
        </message>
        <message>
            <source>both points</source>
            <translation type="unfinished">beide Punkte</translation>
        </message>
        <message>
            <source>the needle</source>
            <translation type="unfinished">die Nadel</translation>
        </message>
        <message>
            <source>at {place}</source>
            <translation type="unfinished">bei {place}</translation>
        </message>
        <message>
            <source>{distance:.0f} mm ahead of {place}</source>
            <translation type="unfinished">ab {place} {distance:.0f} mm voraus</translation>
        </message>
        <message>
            <source>{distance:.0f} mm behind {place}</source>
            <translation type="unfinished">ab {place} {distance:.0f} mm zurück</translation>
        </message>
        <message>
            <source>through {line}</source>
            <translation type="unfinished">durch {line}</translation>
        </message>
        <message>
            <source>{distance:.0f} mm {side} of {line}</source>
            <translation type="unfinished">{distance:.0f} mm {side}, bezogen auf {line}</translation>
        </message>
        <message>
            <source>{step:.2f} mm slices</source>
            <translation type="unfinished">{step:.2f}-mm-Schichten</translation>
        </message>
        <message>
            <source>W {width:.0f}  L {level:.0f}</source>
            <translation type="unfinished">W {width:.0f}  L {level:.0f}</translation>
        </message>
        <message>
            <source>locked</source>
            <translation type="unfinished">gesperrt</translation>
        </message>
        <message>
            <source>inverted</source>
            <translation type="unfinished">invertiert</translation>
        </message>
        <message>
            <source>Zoom {zoom:.1f} px/mm</source>
            <translation type="unfinished">Zoom {zoom:.1f} px/mm</translation>
        </message>
        <message>
            <source>outside the image</source>
            <translation type="unfinished">außerhalb des Bildes</translation>
        </message>
        <message>
            <source>{angle:.0f}° oblique</source>
            <translation type="unfinished">{angle:.0f}° schräg</translation>
        </message>
        <message>
            <source>{position} mm</source>
            <translation type="unfinished">{position} mm</translation>
        </message>
        <message>
            <source>Slice {number} / {count}</source>
            <translation type="unfinished">Schicht {number} / {count}</translation>
        </message>
        <message>
            <source>gantry tilt {angle:.1f}°</source>
            <translation type="unfinished">Gantry-Neigung {angle:.1f}°</translation>
        </message>
        <message>
            <source>{modality}: no Hounsfield units</source>
            <translation type="unfinished">{modality}: keine Hounsfield-Einheiten</translation>
        </message>
        <message>
            <source>1st point</source>
            <translation type="unfinished">1. Punkt</translation>
        </message>
        <message>
            <source>2nd point</source>
            <translation type="unfinished">2. Punkt</translation>
        </message>
        <message>
            <source>{length:g} cm</source>
            <translation type="unfinished">{length:g} cm</translation>
        </message>
        <message>
            <source>{length:g} mm</source>
            <translation type="unfinished">{length:g} mm</translation>
        </message>
        <message>
            <source>{depth:.0f} mm deep</source>
            <translation type="unfinished">{depth:.0f} mm tief</translation>
        </message>
        <message>
            <source>at the target</source>
            <translation type="unfinished">am Ziel</translation>
        </message>
        <message>
            <source>too deep</source>
            <translation type="unfinished">zu tief</translation>
        </message>
        <message>
            <source>on the path again</source>
            <translation type="unfinished">wieder auf dem Pfad</translation>
        </message>
        <message>
            <source>near a structure</source>
            <translation type="unfinished">nahe an einer Struktur</translation>
        </message>
        <message>
            <source>the breath rests</source>
            <translation type="unfinished">der Atem ruht</translation>
        </message>
        <message>
            <source>target touched</source>
            <translation type="unfinished">Ziel berührt</translation>
        </message>
        <message>
            <source>Sounds</source>
            <translation type="unfinished">Töne</translation>
        </message>
        <message>
            <source>The last announcement, which can also be heard: View, Sounds.</source>
            <translation type="unfinished">Die letzte Ansage, die auch zu hören sein kann: Ansicht, Töne.</translation>
        </message>
        <message>
            <source>Sounds of the attempt</source>
            <translation type="unfinished">Töne des Versuchs</translation>
        </message>
        <message>
            <source>Quiet</source>
            <translation type="unfinished">Leise</translation>
        </message>
        <message>
            <source>Medium</source>
            <translation type="unfinished">Mittel</translation>
        </message>
        <message>
            <source>Loud</source>
            <translation type="unfinished">Laut</translation>
        </message>
        <message>
            <source>Depth every 5 mm, the target, the path, scans, structures, the rest of a breath. Everything that is heard is written in the status strip too.</source>
            <translation type="unfinished">Tiefe alle 5 mm, Ziel, Pfad, Scans, Strukturen, Ruhe des Atems. Alles, was zu hören ist, steht auch in der Statuszeile.</translation>
        </message>
        <message>
            <source>new</source>
            <translation type="unfinished">neu</translation>
        </message>
        <message>
            <source>Reading the exercise's structures</source>
            <translation type="unfinished">Strukturen der Übung werden gelesen</translation>
        </message>
        <message>
            <source>Open structures</source>
            <translation type="unfinished">Strukturen öffnen</translation>
        </message>
        <message>
            <source>Open the CT that the structures belong to first.</source>
            <translation type="unfinished">Öffnen Sie zuerst das CT, zu dem die Strukturen gehören.</translation>
        </message>
        <message>
            <source>{name}: {count} structures</source>
            <translation type="unfinished">{name}: Strukturen: {count}</translation>
        </message>
        <message>
            <source>Reading structures</source>
            <translation type="unfinished">Strukturen werden gelesen</translation>
        </message>
        <message>
            <source>3D Slicer segmentation (*.seg.nrrd);;DICOM SEG (*.dcm)</source>
            <translation type="unfinished">3D-Slicer-Segmentierung (*.seg.nrrd);;DICOM SEG (*.dcm)</translation>
        </message>
        <message>
            <source>Save structures</source>
            <translation type="unfinished">Strukturen speichern</translation>
        </message>
        <message>
            <source>Written: {name}</source>
            <translation type="unfinished">Geschrieben: {name}</translation>
        </message>
        <message>
            <source>Writing structures</source>
            <translation type="unfinished">Strukturen werden geschrieben</translation>
        </message>
        <message>
            <source>Structures</source>
            <translation type="unfinished">Strukturen</translation>
        </message>
        <message>
            <source>{low:.0f} to {high:.0f} HU</source>
            <translation type="unfinished">{low:.0f} bis {high:.0f} HU</translation>
        </message>
        <message>
            <source>threshold</source>
            <translation type="unfinished">Schwellenwert</translation>
        </message>
        <message>
            <source>Threshold</source>
            <translation type="unfinished">Schwellenwert</translation>
        </message>
        <message>
            <source>risk</source>
            <translation type="unfinished">Risiko</translation>
        </message>
        <message>
            <source>target</source>
            <translation type="unfinished">Ziel</translation>
        </message>
        <message>
            <source>other</source>
            <translation type="unfinished">andere</translation>
        </message>
        <message>
            <source>{ml:.2f} ml. Tick: drawn. Double click: rename.</source>
            <translation type="unfinished">{ml:.2f} ml. Häkchen: gezeichnet. Doppelklick: umbenennen.</translation>
        </message>
        <message>
            <source>Kind of {name}</source>
            <translation type="unfinished">Art von {name}</translation>
        </message>
        <message>
            <source>Warning distance of {name}</source>
            <translation type="unfinished">Warnabstand von {name}</translation>
        </message>
        <message>
            <source>Warn within so many mm; 0 never</source>
            <translation type="unfinished">Innerhalb so vieler mm warnen; 0 nie</translation>
        </message>
        <message>
            <source>The path comes nearest {depth:.0f} mm behind its entry</source>
            <translation type="unfinished">Der Pfad kommt ihr {depth:.0f} mm hinter seinem Einstichpunkt am nächsten</translation>
        </message>
        <message>
            <source>Warn
[mm]</source>
            <translation type="unfinished">Warnung
[mm]</translation>
        </message>
        <message>
            <source>Path
[mm]</source>
            <translation type="unfinished">Pfad
[mm]</translation>
        </message>
        <message>
            <source>Save…</source>
            <translation type="unfinished">Speichern…</translation>
        </message>
        <message>
            <source> HU</source>
            <translation type="unfinished"> HU</translation>
        </message>
        <message>
            <source>Paint only these values</source>
            <translation type="unfinished">Nur diese Werte malen</translation>
        </message>
        <message>
            <source>All of these values in the body</source>
            <translation type="unfinished">Alle diese Werte im Körper</translation>
        </message>
        <message>
            <source>No structures. Open a DICOM SEG, RTSTRUCT, .seg.nrrd or NIfTI label file, or mark one with the brush.</source>
            <translation type="unfinished">Keine Strukturen. Öffnen Sie DICOM SEG, RTSTRUCT, eine .seg.nrrd- oder NIfTI-Label-Datei, oder markieren Sie eine mit dem Pinsel.</translation>
        </message>
        <message>
            <source>Mark the chosen one, or a new one</source>
            <translation type="unfinished">Die gewählte oder eine neue markieren</translation>
        </message>
        <message>
            <source>Radius</source>
            <translation type="unfinished">Radius</translation>
        </message>
        <message>
            <source>From</source>
            <translation type="unfinished">Von</translation>
        </message>
        <message>
            <source>To</source>
            <translation type="unfinished">Bis</translation>
        </message>
        <message>
            <source>● Paint</source>
            <translation type="unfinished">● Malen</translation>
        </message>
        <message>
            <source>○ Erase</source>
            <translation type="unfinished">○ Radieren</translation>
        </message>
        <message>
            <source>✱ Grow</source>
            <translation type="unfinished">✱ Wachsen</translation>
        </message>
        <message>
            <source>Smallest distance between the needle and a structure that warns. The Structures panel lists distances and kinds.</source>
            <translation type="unfinished">Kleinster Abstand zwischen der Nadel und einer Struktur, die warnt. Der Bereich Strukturen nennt Abstände und Arten.</translation>
        </message>
        <message>
            <source>clear</source>
            <translation type="unfinished">frei</translation>
        </message>
        <message>
            <source>needle in {name}, {depth:.1f} mm deep</source>
            <translation type="unfinished">Nadel in {name}, {depth:.1f} mm tief</translation>
        </message>
        <message>
            <source>{distance:.1f} mm from {name}</source>
            <translation type="unfinished">{distance:.1f} mm von {name}</translation>
        </message>
        <message>
            <source>A bevelled tip cuts a curved path</source>
            <translation type="unfinished">Eine geschliffene Spitze schneidet einen gekrümmten Weg</translation>
        </message>
        <message>
            <source>A branch of the hepatic vein passes 7 mm beside the path, 1 cm before the lesion. Find it in the slices before you begin: it is drawn on them and in 3D. Keep the needle at least 5 mm off it, tip and shaft, all the way; a degree and a half towards it at depth is too much, and a needle that is turned deep sweeps nearer than one that was aimed right. The patient holds the breath.</source>
            <translation type="unfinished">Ein Ast der Lebervene verläuft 7 mm neben dem Pfad, 1 cm vor der Läsion. Suchen Sie ihn in den Schichten, bevor Sie beginnen: Er ist dort und in 3D eingezeichnet. Halten Sie die Nadel auf dem ganzen Weg mindestens 5 mm von ihm entfernt, Spitze und Schaft; anderthalb Grad auf ihn zu sind in der Tiefe zu viel, und eine Nadel, die erst tief gedreht wird, schwenkt näher heran als eine, die von Anfang an richtig gezielt war. Der Patient hält den Atem an.</translation>
        </message>
        <message>
            <source>A holder over the skin turns its guide to the planned path and holds it with four cables; slide the needle to the lesion, hold, and end the attempt. The patient holds the breath. With the dial below zero it pushes the needle away. Whatever fails in it ends the force, and is said.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>A large vessel runs along the path, 2 cm beside it. There is hardly any guidance; the robot pushes the needle aside when it is about to reach the vessel, and back before it leans too far. A needle that meets the vessel or a rib fails. The patient holds the breath.</source>
            <translation type="unfinished">Ein großes Gefäß verläuft am Pfad entlang, 2 cm daneben. Es gibt kaum Führung; der Roboter drückt die Nadel zur Seite, wenn sie das Gefäß zu erreichen droht, und zurück, bevor sie sich zu weit neigt. Trifft die Nadel das Gefäß oder eine Rippe, ist der Versuch nicht bestanden. Der Patient hält den Atem an.</translation>
        </message>
        <message>
            <source>A nodule of 1 cm lies in the right lung. The path runs between two ribs, 28° from the right and 16° from below, so no axial slice shows it whole: follow it in the oblique planes along the needle, or slice by slice. Align exactly before the skin. A rib stops the needle, and touching one fails. Lung gives way: once inside, it hardly holds the needle on its path. The nodule moves a little with every breath: go in while it rests at the end of exhalation.</source>
            <translation type="unfinished">Ein Rundherd von 1 cm liegt in der rechten Lunge. Der Pfad verläuft zwischen zwei Rippen, 28° von rechts und 16° von unten, sodass keine axiale Schicht ihn ganz zeigt: Verfolgen Sie ihn in den schrägen Ebenen entlang der Nadel oder Schicht für Schicht. Richten Sie die Nadel vor der Haut genau aus. Eine Rippe hält die Nadel auf; wer eine berührt, hat nicht bestanden. Lunge gibt nach: Einmal darin, hält sie die Nadel kaum auf ihrem Pfad. Der Rundherd bewegt sich mit jedem Atemzug ein wenig: Führen Sie die Nadel ein, während er am Ende der Ausatmung ruht.</translation>
        </message>
        <message>
            <source>A pen with printed markers before a webcam</source>
            <translation type="unfinished">Ein Stift mit gedruckten Markern vor einer Webcam</translation>
        </message>
        <message>
            <source>A pen with printed markers before one webcam</source>
            <translation type="unfinished">Ein Stift mit gedruckten Markern vor einer einzigen Webcam</translation>
        </message>
        <message>
            <source>A simulated arm carries out the plan</source>
            <translation type="unfinished">Ein simulierter Arm führt den Plan aus</translation>
        </message>
        <message>
            <source>Adversary: attempts that are paid and ought not to be</source>
            <translation type="unfinished">Gegenspieler: Versuche, die belohnt werden und es nicht dürften</translation>
        </message>
        <message>
            <source>Aerated lung crossed</source>
            <translation type="unfinished">Belüftete Lunge durchquert</translation>
        </message>
        <message>
            <source>Against repulsion</source>
            <translation type="unfinished">Gegen Abstoßung</translation>
        </message>
        <message>
            <source>Align the needle with the planned path, insert it to the lesion, hold, and end the attempt. The robot guides strongly; the patient holds the breath.</source>
            <translation type="unfinished">Richten Sie die Nadel am geplanten Pfad aus, führen Sie sie bis zur Läsion ein, halten Sie still und beenden Sie den Versuch. Der Roboter führt stark; der Patient hält den Atem an.</translation>
        </message>
        <message>
            <source>Aligning time</source>
            <translation type="unfinished">Ausrichtzeit</translation>
        </message>
        <message>
            <source>Angle error at the skin</source>
            <translation type="unfinished">Winkelfehler an der Haut</translation>
        </message>
        <message>
            <source>Angle error in plane</source>
            <translation type="unfinished">Winkelfehler in der Ebene</translation>
        </message>
        <message>
            <source>Angle error out of plane</source>
            <translation type="unfinished">Winkelfehler aus der Ebene heraus</translation>
        </message>
        <message>
            <source>Beside the vein</source>
            <translation type="unfinished">Neben der Vene</translation>
        </message>
        <message>
            <source>Bone contacts</source>
            <translation type="unfinished">Knochenkontakte</translation>
        </message>
        <message>
            <source>Bone turns the tip aside</source>
            <translation type="unfinished">Knochen lenkt die Spitze ab</translation>
        </message>
        <message>
            <source>Breath while pushing</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Breathing liver</source>
            <translation type="unfinished">Atmende Leber</translation>
        </message>
        <message>
            <source>Breathing moves the target</source>
            <translation type="unfinished">Die Atmung bewegt das Ziel</translation>
        </message>
        <message>
            <source>Cameras are out of focus or shake</source>
            <translation type="unfinished">Kameras sind unscharf oder wackeln</translation>
        </message>
        <message>
            <source>Cameras count photons and apply a tone curve</source>
            <translation type="unfinished">Kameras zählen Photonen und wenden eine Tonwertkurve an</translation>
        </message>
        <message>
            <source>Cameras deliver JPEG</source>
            <translation type="unfinished">Kameras liefern JPEG</translation>
        </message>
        <message>
            <source>Cameras lose pictures</source>
            <translation type="unfinished">Kameras verlieren Bilder</translation>
        </message>
        <message>
            <source>Centre of an ellipse through the contour on rays</source>
            <translation type="unfinished">Mitte einer Ellipse durch die Kontur auf Strahlen</translation>
        </message>
        <message>
            <source>Compensation of gravity and joint friction</source>
            <translation type="unfinished">Ausgleich von Schwerkraft und Gelenkreibung</translation>
        </message>
        <message>
            <source>Contact of the tip with bone</source>
            <translation type="unfinished">Kontakt der Spitze mit Knochen</translation>
        </message>
        <message>
            <source>Contact: exact hold, midpoint, backward, symplectic, Runge-Kutta, explicit</source>
            <translation type="unfinished">Kontakt: exaktes Halteglied, Mittelpunkt, rückwärts, symplektisch, Runge-Kutta, explizit</translation>
        </message>
        <message>
            <source>Control scans only (assessment)</source>
            <translation type="unfinished">Nur Kontrollscans (Prüfung)</translation>
        </message>
        <message>
            <source>Corners of a board: the window that refines them, by square, slant, edge and noise</source>
            <translation type="unfinished">Ecken einer Tafel: das Fenster, das sie verfeinert, nach Feld, Schräge, Kante und Rauschen</translation>
        </message>
        <message>
            <source>Coverage: stated errors of calibration, pose, tip and registration</source>
            <translation type="unfinished">Überdeckung: angegebene Fehler von Kalibrierung, Lage, Spitze und Registrierung</translation>
        </message>
        <message>
            <source>Cutting of the tissue at the tip</source>
            <translation type="unfinished">Schneiden des Gewebes an der Spitze</translation>
        </message>
        <message>
            <source>Depth error</source>
            <translation type="unfinished">Tiefenfehler</translation>
        </message>
        <message>
            <source>Dimpling and puncture of skin, fascia and capsule</source>
            <translation type="unfinished">Eindellung und Durchstich von Haut, Faszie und Kapsel</translation>
        </message>
        <message>
            <source>Direction held by the robot</source>
            <translation type="unfinished">Vom Roboter gehaltene Richtung</translation>
        </message>
        <message>
            <source>Distance from risk</source>
            <translation type="unfinished">Abstand zur Risikostruktur</translation>
        </message>
        <message>
            <source>Dose (teaching estimate)</source>
            <translation type="unfinished">Dosis (Schätzwert für die Lehre)</translation>
        </message>
        <message>
            <source>Economy of motion</source>
            <translation type="unfinished">Bewegungsökonomie</translation>
        </message>
        <message>
            <source>Entries that planning help tries: how many find the best path</source>
            <translation type="unfinished">Einstichpunkte, die die Planungshilfe probiert: wie viele den besten Pfad finden</translation>
        </message>
        <message>
            <source>Error to the planned target</source>
            <translation type="unfinished">Fehler zum geplanten Ziel</translation>
        </message>
        <message>
            <source>Fat and muscle are thick and stiff. Correct the angle while the needle is shallow: the tissue resists with the cube of the depth. The patient holds the breath.</source>
            <translation type="unfinished">Fett und Muskel sind dick und steif. Korrigieren Sie den Winkel, solange die Nadel noch nicht tief steckt: Das Gewebe widersteht mit der dritten Potenz der Tiefe. Der Patient hält den Atem an.</translation>
        </message>
        <message>
            <source>First insertion</source>
            <translation type="unfinished">Erste Punktion</translation>
        </message>
        <message>
            <source>Force at its limit</source>
            <translation type="unfinished">Kraft an ihrer Grenze</translation>
        </message>
        <message>
            <source>Force at the hand: printed law and virtual work against closed-loop statics</source>
            <translation type="unfinished">Kraft an der Hand: gedruckte Formel und virtuelle Arbeit gegenüber Statik der geschlossenen Kette</translation>
        </message>
        <message>
            <source>Force on bone</source>
            <translation type="unfinished">Kraft auf Knochen</translation>
        </message>
        <message>
            <source>Friction along the needle: Kikuuwe, Dahl, LuGre, and the sign of the speed</source>
            <translation type="unfinished">Reibung entlang der Nadel: Kikuuwe, Dahl, LuGre und das Vorzeichen der Geschwindigkeit</translation>
        </message>
        <message>
            <source>Friction and play of the ball joints</source>
            <translation type="unfinished">Reibung und Spiel der Kugelgelenke</translation>
        </message>
        <message>
            <source>Friction of the tissue along the inserted shaft</source>
            <translation type="unfinished">Reibung des Gewebes am eingeführten Schaft</translation>
        </message>
        <message>
            <source>Fréchet distance from the path</source>
            <translation type="unfinished">Fréchet-Abstand vom Pfad</translation>
        </message>
        <message>
            <source>Grasp: closed form, convex hull, linear programmes, directions tried</source>
            <translation type="unfinished">Griff: geschlossene Formel, konvexe Hülle, lineare Programme, probierte Richtungen</translation>
        </message>
        <message>
            <source>Guidance work</source>
            <translation type="unfinished">Arbeit der Führung</translation>
        </message>
        <message>
            <source>Gut touched</source>
            <translation type="unfinished">Darm berührt</translation>
        </message>
        <message>
            <source>Hard cases: every subsystem where its formulas are delicate</source>
            <translation type="unfinished">Schwierige Fälle: jedes Teilsystem dort, wo seine Formeln heikel sind</translation>
        </message>
        <message>
            <source>Hold the breath</source>
            <translation type="unfinished">Atem anhalten</translation>
        </message>
        <message>
            <source>Holding time</source>
            <translation type="unfinished">Haltezeit</translation>
        </message>
        <message>
            <source>Impedance at the tool point: virtual mass, spring and damper</source>
            <translation type="unfinished">Impedanz am Werkzeugpunkt: virtuelle Masse, Feder und Dämpfer</translation>
        </message>
        <message>
            <source>Insertion time</source>
            <translation type="unfinished">Punktionszeit</translation>
        </message>
        <message>
            <source>Inverse kinematics of the arm: closed forms, damped least squares, other programs</source>
            <translation type="unfinished">Inverse Kinematik des Arms: geschlossene Formeln, gedämpfte kleinste Quadrate, andere Programme</translation>
        </message>
        <message>
            <source>Inverse kinematics of the pantograph: closed form, Newton, table</source>
            <translation type="unfinished">Inverse Kinematik des Pantographen: geschlossene Formel, Newton, Tabelle</translation>
        </message>
        <message>
            <source>Kidney from behind</source>
            <translation type="unfinished">Niere von hinten</translation>
        </message>
        <message>
            <source>Laparoscopic tool</source>
            <translation type="unfinished">Laparoskopisches Instrument</translation>
        </message>
        <message>
            <source>Lateral tissue: rigid needle on springs against a beam on an elastic foundation</source>
            <translation type="unfinished">Seitliches Gewebe: starre Nadel auf Federn gegenüber Balken auf elastischer Bettung</translation>
        </message>
        <message>
            <source>Least squares of the band's whole picture</source>
            <translation type="unfinished">Kleinste Quadrate über das ganze Bild des Bands</translation>
        </message>
        <message>
            <source>Letting go of the needle: force to be had against run-away</source>
            <translation type="unfinished">Loslassen der Nadel: nutzbare Kraft gegenüber dem Davonlaufen</translation>
        </message>
        <message>
            <source>Light before the cameras</source>
            <translation type="unfinished">Licht vor den Kameras</translation>
        </message>
        <message>
            <source>Lung, oblique twice between ribs</source>
            <translation type="unfinished">Lunge, doppelt schräg zwischen Rippen</translation>
        </message>
        <message>
            <source>Mask, then the centroid of the covered shares</source>
            <translation type="unfinished">Maske, dann der Schwerpunkt der bedeckten Anteile</translation>
        </message>
        <message>
            <source>Mean distance from the path (DTW)</source>
            <translation type="unfinished">Mittlerer Abstand vom Pfad (DTW)</translation>
        </message>
        <message>
            <source>Mean force, estimated</source>
            <translation type="unfinished">Mittlere Kraft, geschätzt</translation>
        </message>
        <message>
            <source>Metrics against what is published of them</source>
            <translation type="unfinished">Messgrößen gegenüber dem, was darüber veröffentlicht ist</translation>
        </message>
        <message>
            <source>Motion at a trocar</source>
            <translation type="unfinished">Bewegung an einem Trokar</translation>
        </message>
        <message>
            <source>Oblique slices: nearest, trilinear, cubic</source>
            <translation type="unfinished">Schräge Schichten: nächster Nachbar, trilinear, kubisch</translation>
        </message>
        <message>
            <source>Open at half size</source>
            <translation type="unfinished">In halber Größe öffnen</translation>
        </message>
        <message>
            <source>Open resampled</source>
            <translation type="unfinished">Neu berechnet öffnen</translation>
        </message>
        <message>
            <source>Open straightened</source>
            <translation type="unfinished">Gerade gerichtet öffnen</translation>
        </message>
        <message>
            <source>Other organs crossed</source>
            <translation type="unfinished">Andere Organe durchquert</translation>
        </message>
        <message>
            <source>Passes through a capsule</source>
            <translation type="unfinished">Durchtritte durch eine Kapsel</translation>
        </message>
        <message>
            <source>Passes through the skin</source>
            <translation type="unfinished">Durchtritte durch die Haut</translation>
        </message>
        <message>
            <source>Past the vessel</source>
            <translation type="unfinished">Am Gefäß vorbei</translation>
        </message>
        <message>
            <source>Path length</source>
            <translation type="unfinished">Weglänge</translation>
        </message>
        <message>
            <source>Path length, raw</source>
            <translation type="unfinished">Weglänge, roh</translation>
        </message>
        <message>
            <source>Path ratio</source>
            <translation type="unfinished">Wegverhältnis</translation>
        </message>
        <message>
            <source>Peak force, estimated</source>
            <translation type="unfinished">Spitzenkraft, geschätzt</translation>
        </message>
        <message>
            <source>Pleural angle</source>
            <translation type="unfinished">Pleurawinkel</translation>
        </message>
        <message>
            <source>Pleural crossings</source>
            <translation type="unfinished">Pleuradurchtritte</translation>
        </message>
        <message>
            <source>Pose and tip of the pen</source>
            <translation type="unfinished">Lage und Spitze des Stifts</translation>
        </message>
        <message>
            <source>Published: needles in tissue, measured and ours</source>
            <translation type="unfinished">Veröffentlicht: Nadeln in Gewebe, gemessen und bei uns</translation>
        </message>
        <message>
            <source>Rate of the recorded path</source>
            <translation type="unfinished">Rate des aufgezeichneten Wegs</translation>
        </message>
        <message>
            <source>Read the planning CT, align the needle by the plan and take control scans where you would in the scanner room: choose table position and 3 to 5 slices, press the pedal (S). A tip outside the slices is not seen. There is no other view of the needle and no guidance by the robot. Use few scans. The patient holds the breath.</source>
            <translation type="unfinished">Lesen Sie das Planungs-CT, richten Sie die Nadel nach dem Plan aus und machen Sie Kontrollscans dort, wo Sie es am Scanner täten: Wählen Sie Tischposition und 3 bis 5 Schichten, drücken Sie das Pedal (S). Eine Spitze außerhalb der Schichten ist nicht zu sehen. Eine andere Ansicht der Nadel gibt es nicht, und der Roboter führt nicht. Kommen Sie mit wenigen Scans aus. Der Patient hält den Atem an.</translation>
        </message>
        <message>
            <source>Reading DICOM: Acus against GDCM through SimpleITK</source>
            <translation type="unfinished">DICOM lesen: Acus gegenüber GDCM über SimpleITK</translation>
        </message>
        <message>
            <source>Redirects</source>
            <translation type="unfinished">Richtungskorrekturen</translation>
        </message>
        <message>
            <source>Region that the needle must not enter</source>
            <translation type="unfinished">Bereich, in den die Nadel nicht eindringen darf</translation>
        </message>
        <message>
            <source>Relaxation of dimpled tissue</source>
            <translation type="unfinished">Entspannung eingedellten Gewebes</translation>
        </message>
        <message>
            <source>Side stiffness of layered tissue about the fulcrum</source>
            <translation type="unfinished">Seitliche Steifigkeit geschichteten Gewebes um den Drehpunkt</translation>
        </message>
        <message>
            <source>Smoothness (LDLJ)</source>
            <translation type="unfinished">Bewegungsglätte (LDLJ)</translation>
        </message>
        <message>
            <source>Smoothness (SPARC)</source>
            <translation type="unfinished">Bewegungsglätte (SPARC)</translation>
        </message>
        <message>
            <source>Smoothness: rate of the sampled speed</source>
            <translation type="unfinished">Bewegungsglätte: Rate der abgetasteten Geschwindigkeit</translation>
        </message>
        <message>
            <source>Stable (K, B) of the free device over rate and delay</source>
            <translation type="unfinished">Stabile (K, B) des freien Geräts über Rate und Verzögerung</translation>
        </message>
        <message>
            <source>Substeps of the simulated robot</source>
            <translation type="unfinished">Teilschritte des simulierten Roboters</translation>
        </message>
        <message>
            <source>Surfaces of the 3D view: resolution of the grid against time</source>
            <translation type="unfinished">Oberflächen der 3D-Ansicht: Auflösung des Gitters gegenüber Zeit</translation>
        </message>
        <message>
            <source>Target error</source>
            <translation type="unfinished">Zielfehler</translation>
        </message>
        <message>
            <source>Targets touched</source>
            <translation type="unfinished">Berührte Ziele</translation>
        </message>
        <message>
            <source>The arm inserts its tool by pictures alone: success, failures and errors</source>
            <translation type="unfinished">Der Arm führt sein Instrument nur nach Bildern ein: Erfolg, Fehlschläge und Fehler</translation>
        </message>
        <message>
            <source>The arm with its hand and its long tool</source>
            <translation type="unfinished">Der Arm mit seiner Hand und seinem langen Instrument</translation>
        </message>
        <message>
            <source>The arm's kinematics</source>
            <translation type="unfinished">Die Kinematik des Arms</translation>
        </message>
        <message>
            <source>The arm's motion: planner and budget against success and length</source>
            <translation type="unfinished">Die Bewegung des Arms: Planer und Budget gegenüber Erfolg und Länge</translation>
        </message>
        <message>
            <source>The fulcrum from pictures: motion of the shaft, or the trocar itself</source>
            <translation type="unfinished">Der Drehpunkt aus Bildern: Bewegung des Schafts oder der Trokar selbst</translation>
        </message>
        <message>
            <source>The laboratory's published detection</source>
            <translation type="unfinished">Die veröffentlichte Erkennung des Labors</translation>
        </message>
        <message>
            <source>The lesion moves with every breath, mostly towards the feet and back. Watch the motion, insert during the rest at the end of exhalation, and end the attempt with the tip in the lesion. A needle in the liver is dragged along with it.</source>
            <translation type="unfinished">Die Läsion bewegt sich mit jedem Atemzug, vor allem fußwärts und nach hinten. Beobachten Sie die Bewegung, führen Sie die Nadel während der Ruhe am Ende der Ausatmung ein, und beenden Sie den Versuch mit der Spitze in der Läsion. Eine Nadel in der Leber wird mitgezogen.</translation>
        </message>
        <message>
            <source>The lesion moves with every breath. Tell the patient to hold (key A, or the button): he breathes in and out once more and holds. Look where the lesion lies now, for no two holds have it at the same place; aim there, insert, end the attempt while he holds. After 20 s he has to breathe; let him breathe in between, then hold again.</source>
            <translation type="unfinished">Die Läsion bewegt sich mit jedem Atemzug. Lassen Sie den Patienten den Atem anhalten (Taste A oder die Schaltfläche): Er atmet noch einmal ein und aus und hält dann an. Sehen Sie nach, wo die Läsion jetzt liegt, denn bei keinem Anhalten liegt sie am selben Ort wie beim vorigen; zielen Sie dorthin, führen Sie die Nadel ein, beenden Sie den Versuch, solange er anhält. Nach 20 s muss er atmen; lassen Sie ihn zwischendurch atmen und dann wieder anhalten.</translation>
        </message>
        <message>
            <source>The machines side by side: workspace, resolution, stiffness, force, effort, cost</source>
            <translation type="unfinished">Die Maschinen im Vergleich: Arbeitsraum, Auflösung, Steifigkeit, Kraft, Aufwand, Kosten</translation>
        </message>
        <message>
            <source>The marker in a picture: four extractors and two Cramér-Rao bounds</source>
            <translation type="unfinished">Der Marker in einem Bild: vier Verfahren und zwei Cramér-Rao-Schranken</translation>
        </message>
        <message>
            <source>The pantograph's formulas: closure, and the errors of the printed ones</source>
            <translation type="unfinished">Die Formeln des Pantographen: Schließung und die Fehler der gedruckten</translation>
        </message>
        <message>
            <source>The patient lies on the belly. The target is the parenchyma of the left kidney's lower half; the path comes from the flank, below the ribs, and leans to both sides of the axial plane. Check in three planes where it runs, align before you push, and hold the angle through the muscle of the back: it is stiffer than the fat behind the kidney. The kidney moves with every breath, mostly towards the feet: go in while it rests at the end of exhalation.</source>
            <translation type="unfinished">Der Patient liegt auf dem Bauch. Ziel ist das Parenchym der unteren Hälfte der linken Niere; der Pfad kommt von der Flanke, unterhalb der Rippen, und ist nach beiden Seiten gegen die axiale Ebene geneigt. Prüfen Sie in drei Ebenen, wo er verläuft, richten Sie aus, bevor Sie vorschieben, und halten Sie den Winkel durch den Rückenmuskel: Er ist steifer als das Fett hinter der Niere. Die Niere bewegt sich mit jedem Atemzug, vor allem fußwärts: Führen Sie die Nadel ein, während sie am Ende der Ausatmung ruht.</translation>
        </message>
        <message>
            <source>The robot guides strongly at first; the patient holds the breath. Each good attempt lowers its help by a step, each poor one raises it again. Every fourth attempt is a probe: no force guides you, and neither overlay nor bull's-eye shows the needle. Read the path on the CT beforehand, align by the slices and the robot in space, and feel how deep you are.</source>
            <translation type="unfinished">Der Roboter führt anfangs stark; der Patient hält den Atem an. Jeder gute Versuch senkt seine Hilfe um einen Schritt, jeder schlechte hebt sie wieder an. Jeder vierte Versuch ist ein Testversuch: Keine Kraft führt Sie, und weder Einblendung noch Zielscheibe zeigen die Nadel. Lesen Sie den Pfad vorher im CT, richten Sie nach den Schichten und dem Roboter im Raum aus, und fühlen Sie, wie tief Sie sind.</translation>
        </message>
        <message>
            <source>The robot pushes the needle off the planned path, gently. Hold it on the path by small, early corrections; exactly on the path there is no force. If you give way, the push fades. The patient holds the breath.</source>
            <translation type="unfinished">Der Roboter drückt die Nadel sanft vom geplanten Pfad weg. Halten Sie sie durch kleine, frühe Korrekturen auf dem Pfad; genau auf dem Pfad wirkt keine Kraft. Geben Sie nach, lässt der Druck nach. Der Patient hält den Atem an.</translation>
        </message>
        <message>
            <source>The target gives way to the needle</source>
            <translation type="unfinished">Das Ziel weicht der Nadel aus</translation>
        </message>
        <message>
            <source>The target is the lesion in the liver. Find an entry from which a straight path meets neither rib nor lung nor vessel and that the robot can follow, place it (E, or the map of entries in the panel Plan), then insert the needle along your own path. A rib stops the needle; meeting one, or lung, gut or a large vessel, fails. The patient holds the breath.</source>
            <translation type="unfinished">Ziel ist die Läsion in der Leber. Finden Sie einen Einstichpunkt, von dem ein gerader Pfad weder Rippe noch Lunge noch Gefäß trifft und dem der Roboter folgen kann, setzen Sie ihn (E oder die Karte der Einstichpunkte im Bereich Plan), und führen Sie dann die Nadel entlang Ihres eigenen Pfads ein. Eine Rippe hält die Nadel auf; wer eine Rippe, Lunge, Darm oder ein großes Gefäß trifft, hat nicht bestanden. Der Patient hält den Atem an.</translation>
        </message>
        <message>
            <source>The tensegrity needle holder: workspace, closure, conditioning, stiffness, encoders</source>
            <translation type="unfinished">Der Tensegrity-Nadelhalter: Arbeitsraum, Schließung, Konditionierung, Steifigkeit, Encoder</translation>
        </message>
        <message>
            <source>The tip on the screen: newest fix, Kalman, one euro</source>
            <translation type="unfinished">Die Spitze auf dem Bildschirm: neueste Messung, Kalman, One Euro</translation>
        </message>
        <message>
            <source>The tool and the trocar in pictures</source>
            <translation type="unfinished">Instrument und Trokar in Bildern</translation>
        </message>
        <message>
            <source>The waveform of breathing: product, power, table, sum of cosines</source>
            <translation type="unfinished">Die Wellenform der Atmung: Produkt, Potenz, Tabelle, Summe von Kosinus</translation>
        </message>
        <message>
            <source>Thick tissue</source>
            <translation type="unfinished">Dickes Gewebe</translation>
        </message>
        <message>
            <source>Through the cable-driven holder</source>
            <translation type="unfinished">Durch den seilgeführten Halter</translation>
        </message>
        <message>
            <source>Time inside risk</source>
            <translation type="unfinished">Zeit in Risikostrukturen</translation>
        </message>
        <message>
            <source>Time per target</source>
            <translation type="unfinished">Zeit je Ziel</translation>
        </message>
        <message>
            <source>Tissue at the tip, from the patient's field</source>
            <translation type="unfinished">Gewebe an der Spitze, aus dem Gewebefeld des Patienten</translation>
        </message>
        <message>
            <source>Tissue: layers along the plan against fields of labels in the patient</source>
            <translation type="unfinished">Gewebe: Gewebeschichten entlang des Plans gegenüber Labelfeldern im Patienten</translation>
        </message>
        <message>
            <source>Too near to risk</source>
            <translation type="unfinished">Zu nah an Risikostrukturen</translation>
        </message>
        <message>
            <source>Total time</source>
            <translation type="unfinished">Gesamtzeit</translation>
        </message>
        <message>
            <source>Tracking valid</source>
            <translation type="unfinished">Tracking gültig</translation>
        </message>
        <message>
            <source>Trials: the loop alone, a trainer, a trainer with rendered pictures</source>
            <translation type="unfinished">Testläufe: nur die Regelschleife, ein Trainer, ein Trainer mit gerenderten Bildern</translation>
        </message>
        <message>
            <source>Triangulation: three ways, and figure 42 redone</source>
            <translation type="unfinished">Triangulation: drei Wege, und Abbildung 42 neu gerechnet</translation>
        </message>
        <message>
            <source>Velocity from encoder angles</source>
            <translation type="unfinished">Geschwindigkeit aus Encoderwinkeln</translation>
        </message>
        <message>
            <source>Vessels touched</source>
            <translation type="unfinished">Gefäße berührt</translation>
        </message>
        <message>
            <source>Views of a board that calibrate a camera</source>
            <translation type="unfinished">Aufnahmen einer Tafel, die eine Kamera kalibrieren</translation>
        </message>
        <message>
            <source>Virtual fixture: guides to the path or repels from it</source>
            <translation type="unfinished">Virtuelle Führung: führt zum Pfad oder drückt von ihm weg</translation>
        </message>
        <message>
            <source>Wall before the tilt limit</source>
            <translation type="unfinished">Wand vor der Neigungsgrenze</translation>
        </message>
        <message>
            <source>With less and less help</source>
            <translation type="unfinished">Mit immer weniger Hilfe</translation>
        </message>
        <message>
            <source>You hold the handle of a long tool that goes through a trocar. Move the handle to the left and the tip goes to the right, the further the deeper it is. Touch the numbered targets one after the other: bring the tip onto the target that is marked, and hold it there until the next one is. Go straight to each; press Enter after the last.</source>
            <translation type="unfinished">Sie halten den Griff eines langen Instruments, das durch einen Trokar geht. Bewegen Sie den Griff nach links, geht die Spitze nach rechts, und zwar umso weiter, je tiefer sie ist. Berühren Sie die nummerierten Ziele eines nach dem anderen: Bringen Sie die Spitze auf das markierte Ziel und halten Sie sie dort, bis das nächste markiert ist. Gehen Sie zu jedem auf geradem Weg; drücken Sie nach dem letzten Eingabe.</translation>
        </message>
        <message>
            <source>Align only: it ends as the tip goes through the skin, and only the tilt there counts.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Depth only: you begin aligned, and only the depth counts.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Breath only: push while the target is in its place, wait while it is not; nothing else counts.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Ten times three minutes: the whole exercise; each round ends by itself after three minutes.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>the field: {because}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>layers: {because}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>a needle {angle:.0f}° from upright</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{where} meets {name} at {begin_mm:.0f} mm, which the path does not</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{where} meets {others}, the path {own}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>{where} feels {most:.1f} N more or less at {depth:.0f} mm than the path</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>every needle within reach meets {names} with the same force to {most:.2f} N</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>the breath does not move the target</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>the needle was never pushed deeper</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>a hand's unsteadiness needs finite numbers of 0 or more, and a lag and a memory above 0, got {this}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Breath</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>How far the breath has moved the target from where the CT has it. In the band it is within the inner ring: push there, wait elsewhere.</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>✔ at rest: push</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>▲ {mm:.0f} mm away: wait</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Click: this slice alone, with all that a slice can do</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Technician</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>practise, progress, help</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>also patients, exercises, courses and results</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>also robot, cameras, checks, effects and cost of accuracy</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Put panels away ({key})</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>All panels ({key})</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Live pictures ({key})</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Control scan again ({key})</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Role</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>An attempt is running: end it before the role is changed</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Role: {role}</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Who sits here: it decides what the window has ({key})</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Go on to the attempt</source>
            <translation type="unfinished" />
        </message>
        <message>
            <source>Back to the plan</source>
            <translation type="unfinished" />
        </message>
    </context>
</TS>
