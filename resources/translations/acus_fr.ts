<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="fr_FR">
    <context>
        <name />
        <message>
            <source>in {exercise_id} targets are touched, and the arm inserts along a path: name another exercise, or leave out --device arm</source>
            <translation type="unfinished">dans {exercise_id}, on touche des cibles, et le bras introduit le long d’une trajectoire : indiquez un autre exercice, ou omettez --device arm</translation>
        </message>
        <message>
            <source>the arm works before its own simulated cameras; leave out --pen and --cameras</source>
            <translation type="unfinished">le bras travaille devant ses propres caméras simulées ; omettez --pen et --cameras</translation>
        </message>
        <message>
            <source>&amp;Sessions</source>
            <translation type="unfinished">&amp;Séances</translation>
        </message>
        <message>
            <source>Watch the arm do my plan</source>
            <translation type="unfinished">Voir le bras suivre mon plan</translation>
        </message>
        <message>
            <source>A simulated arm carries out the plan on screen. {only}</source>
            <translation type="unfinished">Un bras simulé exécute le plan à l’écran. {only}</translation>
        </message>
        <message>
            <source>Watch the arm (W)</source>
            <translation type="unfinished">Regarder le bras (W)</translation>
        </message>
        <message>
            <source>A simulated arm carries out the plan; it counts for nobody, and drives no real arm</source>
            <translation type="unfinished">Un bras simulé exécute le plan ; cela ne compte pour personne et ne commande aucun vrai bras</translation>
        </message>
        <message>
            <source>The arm is at it already; Esc stops it.</source>
            <translation type="unfinished">Le bras y travaille déjà ; Échap l’arrête.</translation>
        </message>
        <message>
            <source>Choose an exercise first: File ▸ Start page.</source>
            <translation type="unfinished">Choisissez d’abord un exercice : Fichier ▸ Page d’accueil.</translation>
        </message>
        <message>
            <source>An attempt is running: end it first, then let the arm do your plan.</source>
            <translation type="unfinished">Un essai est en cours : terminez-le d’abord, puis laissez le bras exécuter votre plan.</translation>
        </message>
        <message>
            <source>This is an assessment: you do it yourself, the arm cannot do it for you.</source>
            <translation type="unfinished">C’est une évaluation : vous la faites vous-même, le bras ne peut pas la faire pour vous.</translation>
        </message>
        <message>
            <source>Here targets are touched: the arm inserts along a path and leaves them to you.</source>
            <translation type="unfinished">Ici, on touche des cibles : le bras introduit le long d’une trajectoire et vous les laisse.</translation>
        </message>
        <message>
            <source>The arm does not do what you may not begin: {why}.</source>
            <translation type="unfinished">Le bras ne fait pas ce que vous ne pouvez pas commencer : {why}.</translation>
        </message>
        <message>
            <source>Place entry and target first (E, T): the arm follows your plan.</source>
            <translation type="unfinished">Placez d’abord le point d’entrée et la cible (E, T) : le bras suit votre plan.</translation>
        </message>
        <message>
            <source>Finish a plan that the robot can follow first; the panel Plan says why not.</source>
            <translation type="unfinished">Terminez d’abord un plan que le robot peut suivre ; le panneau Plan dit ce qui manque.</translation>
        </message>
        <message>
            <source>Simulated arm: works out its way …  {only}</source>
            <translation type="unfinished">Bras simulé : calcule son chemin …  {only}</translation>
        </message>
        <message>
            <source>Simulated arm: works out its way, {n:.0f} %</source>
            <translation type="unfinished">Bras simulé : calcule son chemin, {n:.0f} %</translation>
        </message>
        <message>
            <source>Let it stand {angle:.0f}° further round, and try again</source>
            <translation type="unfinished">Le placer {angle:.0f}° plus loin autour, et réessayer</translation>
        </message>
        <message>
            <source>The plan was changed meanwhile: ask again for the new one.</source>
            <translation type="unfinished">Le plan a été modifié entre-temps : redemandez pour le nouveau.</translation>
        </message>
        <message>
            <source>You have the needle: go on with mouse or keys. This attempt counts for nobody.</source>
            <translation type="unfinished">L’aiguille est à vous : continuez à la souris ou au clavier. Cet essai ne compte pour personne.</translation>
        </message>
        <message>
            <source>the arm does it</source>
            <translation type="unfinished">le bras le fait</translation>
        </message>
        <message>
            <source>points have shape {points_shape}; (n, 2) or (n, 3) is needed</source>
            <translation type="unfinished">les points sont de forme {points_shape} ; il faut (n, 2) ou (n, 3)</translation>
        </message>
        <message>
            <source>{points_shape} points have normals of shape {normals_shape}</source>
            <translation type="unfinished">les points {points_shape} ont des normales de forme {normals_shape}</translation>
        </message>
        <message>
            <source>{name} is {bound}; give 0 or more</source>
            <translation type="unfinished">{name} vaut {bound} ; donnez 0 ou plus</translation>
        </message>
        <message>
            <source>in the plane no contact turns about its normal; leave soft at 0</source>
            <translation type="unfinished">dans le plan, aucun contact ne tourne autour de sa normale ; laissez soft à 0</translation>
        </message>
        <message>
            <source>no force holds the tool: {reason}</source>
            <translation type="unfinished">aucune force ne tient l’instrument : {reason}</translation>
        </message>
        <message>
            <source>a friction cone in space with {edges} edges; give 3 or more</source>
            <translation type="unfinished">un cône de frottement dans l’espace avec {edges} arêtes ; donnez-en 3 ou plus</translation>
        </message>
        <message>
            <source>all contacts are one point: torques have no scale; give scale=...</source>
            <translation type="unfinished">tous les contacts sont un seul point : les couples n’ont pas d’échelle ; donnez scale=...</translation>
        </message>
        <message>
            <source>the torque scale is {scale} m; a positive length is needed</source>
            <translation type="unfinished">l’échelle des couples est de {scale} m ; il faut une longueur positive</translation>
        </message>
        <message>
            <source>the origin is outside the wrenches' hull: no ray ends in it</source>
            <translation type="unfinished">l’origine est hors de l’enveloppe des torseurs : aucun rayon n’y aboutit</translation>
        </message>
        <message>
            <source>no closed form for {rays} rays of {dimensions} dimensions, only for two contacts in the plane</source>
            <translation type="unfinished">pas de forme close pour {rays} rayons en {dimensions} dimensions, seulement pour deux contacts dans le plan</translation>
        </message>
        <message>
            <source>this test is for two contacts in the plane</source>
            <translation type="unfinished">ce test vaut pour deux contacts dans le plan</translation>
        </message>
        <message>
            <source>both contacts are one point: no line joins them</source>
            <translation type="unfinished">les deux contacts sont un seul point : aucune ligne ne les relie</translation>
        </message>
        <message>
            <source>a linear programme of {unknowns} unknowns ended with: {ending}</source>
            <translation type="unfinished">un programme linéaire à {unknowns} inconnues s’est terminé par : {ending}</translation>
        </message>
        <message>
            <source>hand: {name} is {length} m; a positive length is needed</source>
            <translation type="unfinished">main : {name} vaut {length} m ; il faut une longueur positive</translation>
        </message>
        <message>
            <source>hand: {name} is {angle} rad; give more than 0, at most π</source>
            <translation type="unfinished">main : {name} vaut {angle} rad ; donnez plus de 0, au plus π</translation>
        </message>
        <message>
            <source>hand: pad is {pad} m; give 0 or more, less than distal, {distal} m</source>
            <translation type="unfinished">main : pad vaut {pad} m ; donnez 0 ou plus, moins que distal, {distal} m</translation>
        </message>
        <message>
            <source>hand: bend is {bend} rad; give 0 or more, less than π</source>
            <translation type="unfinished">main : bend vaut {bend} rad ; donnez 0 ou plus, moins que π</translation>
        </message>
        <message>
            <source>hand: gears {proximal_gear} (proximal) and {distal_gear} (distal); the distal one must be positive and the smaller, or the tip would open in closing</source>
            <translation type="unfinished">main : rapports {proximal_gear} (proximal) et {distal_gear} (distal) ; le distal doit être positif et le plus petit, sinon le bout s’ouvrirait à la fermeture</translation>
        </message>
        <message>
            <source>hand: breakaway is {breakaway} N·m; a positive torque is needed</source>
            <translation type="unfinished">main : breakaway vaut {breakaway} N·m ; il faut un couple positif</translation>
        </message>
        <message>
            <source>finger {finger_name} does not reach ({x:.6g}, {y:.6g}, {z:.6g}) mm: {reason}</source>
            <translation type="unfinished">le doigt {finger_name} n’atteint pas ({x:.6g}, {y:.6g}, {z:.6g}) mm : {reason}</translation>
        </message>
        <message>
            <source>the motor stands at {motor} rad and joint 2 broke away at {broken_at} rad; give 0 ≤ broken_at ≤ motor</source>
            <translation type="unfinished">le moteur est à {motor} rad et l’articulation 2 s’est débrayée à {broken_at} rad ; donnez 0 ≤ broken_at ≤ motor</translation>
        </message>
        <message>
            <source>it is {reach_mm:.4g} mm from joint 2, the links reach from {near:.4g} to {far:.4g} mm</source>
            <translation type="unfinished">le point est à {reach_mm:.4g} mm de l’articulation 2, les segments atteignent de {near:.4g} à {far:.4g} mm</translation>
        </message>
        <message>
            <source>{name} would be {angle_deg:.4g}°, its limits are 0 and {most_deg:.4g}°</source>
            <translation type="unfinished">{name} serait de {angle_deg:.4g}°, ses limites sont 0 et {most_deg:.4g}°</translation>
        </message>
        <message>
            <source>closing moves the grasp point by {free:.4g} m/rad, with joint 2 held by {alone:.4g} m/rad; both must be into the tool: choose another posture</source>
            <translation type="unfinished">la fermeture déplace le point de prise de {free:.4g} m/rad, et de {alone:.4g} m/rad avec l’articulation 2 bloquée ; les deux doivent aller vers l’instrument : choisissez une autre posture</translation>
        </message>
        <message>
            <source>contact: {name} is {setting} {unit_name}; give {least}</source>
            <translation type="unfinished">contact : {name} vaut {setting} {unit_name} ; il faut : {least}</translation>
        </message>
        <message>
            <source>firm grasp: {name} is {setting}; give more than 0</source>
            <translation type="unfinished">prise ferme : {name} vaut {setting} ; donnez plus de 0</translation>
        </message>
        <message>
            <source>firm grasp: gain is {gain} rad/s per N; give more than 0</source>
            <translation type="unfinished">prise ferme : gain vaut {gain} rad/s par N ; donnez plus de 0</translation>
        </message>
        <message>
            <source>a gain of {used_gain:.4g} rad/s per N makes a contact of {contact_stiffness:.4g} N/m and {contact_damping:.4g} N·s/m oscillate ever more; give less than {most:.4g}, or leave it out</source>
            <translation type="unfinished">un gain de {used_gain:.4g} rad/s par N fait osciller de plus en plus un contact de {contact_stiffness:.4g} N/m et {contact_damping:.4g} N·s/m ; donnez moins de {most:.4g}, ou omettez-le</translation>
        </message>
        <message>
            <source>after {seconds:.3g} s the force is {force:.4g} N, not {goal:.4g} N; give it more time, or a gain for a softer contact</source>
            <translation type="unfinished">après {seconds:.3g} s, la force est de {force:.4g} N, pas de {goal:.4g} N ; donnez plus de temps, ou un gain pour un contact plus souple</translation>
        </message>
        <message>
            <source>a press of {duration} s has {count:.4g} periods of {law_period} s; give 1 to 1e6</source>
            <translation type="unfinished">une pression de {duration} s compte {count:.4g} périodes de {law_period} s ; donnez-en 1 à 1e6</translation>
        </message>
        <message>
            <source>no hand {wanted!r}; valid names: {hand_names}, or the path of a .yaml file</source>
            <translation type="unfinished">pas de main {wanted!r} ; noms valides : {hand_names}, ou le chemin d’un fichier .yaml</translation>
        </message>
        <message>
            <source>a tool of diameter {diameter} m; a positive one is needed</source>
            <translation type="unfinished">un instrument de diamètre {diameter} m ; il en faut un positif</translation>
        </message>
        <message>
            <source>the palm would come along the tool's axis; give a direction across it (the axis is {round})</source>
            <translation type="unfinished">la paume viendrait le long de l’axe de l’instrument ; donnez une direction transversale (l’axe est {round})</translation>
        </message>
        <message>
            <source>the tool's axis at {chosen_mm:.4g} mm above joint 2: the tips meet on a tool of {tool_world_diameter_mm:.4g} mm from {least_mm:.4g} to {most_mm:.4g} mm</source>
            <translation type="unfinished">l’axe de l’instrument à {chosen_mm:.4g} mm au-dessus de l’articulation 2 : les bouts se rejoignent sur un instrument de {tool_world_diameter_mm:.4g} mm de {least_mm:.4g} à {most_mm:.4g} mm</translation>
        </message>
        <message>
            <source>a tool of {radius_mm:.4g} mm: the fingers open to {widest_mm:.4g} mm and cannot close on it</source>
            <translation type="unfinished">un instrument de {radius_mm:.4g} mm : les doigts s’ouvrent à {widest_mm:.4g} mm et ne peuvent pas se refermer dessus</translation>
        </message>
        <message>
            <source>a tool of {radius_mm:.4g} mm would be met at {most_mm:.4g} mm above joint 2, where it is in the palm</source>
            <translation type="unfinished">un instrument de {radius_mm:.4g} mm serait touché à {most_mm:.4g} mm au-dessus de l’articulation 2, où il est dans la paume</translation>
        </message>
        <message>
            <source>spread {spread_deg:.4g}°; its limits are 0 and {geometry_most_spread_deg:.4g}°</source>
            <translation type="unfinished">écartement {spread_deg:.4g}° ; ses limites sont 0 et {geometry_most_spread_deg:.4g}°</translation>
        </message>
        <message>
            <source>finger {finger_name} stands in the tool with its {link} link when open; move the hand back, or change the spread</source>
            <translation type="unfinished">le doigt {finger_name}, ouvert, est dans l’instrument par son segment {link} ; reculez la main, ou changez l’écartement</translation>
        </message>
        <message>
            <source>finger {finger_name} closes to its limit without touching the tool; bring the hand nearer, or change the spread</source>
            <translation type="unfinished">le doigt {finger_name} se ferme jusqu’à sa limite sans toucher l’instrument ; approchez la main, ou changez l’écartement</translation>
        </message>
        <message>
            <source>the tool stands in the palm, {deep}; the palm lies {geometry_joint_height_mm:.3g} mm below joint 2: move the hand back</source>
            <translation type="unfinished">l’instrument est dans la paume, {deep} ; la paume est à {geometry_joint_height_mm:.3g} mm sous l’articulation 2 : reculez la main</translation>
        </message>
        <message>
            <source>the path leans {lean:.0f}° from straight down; a tool goes through the skin up to {flattest_deg:.0f}°</source>
            <translation type="unfinished">la trajectoire s’écarte de {lean:.0f}° de la verticale ; un instrument traverse la peau jusqu’à {flattest_deg:.0f}°</translation>
        </message>
        <message>
            <source>{name} has shape {array_shape}; (7,) is needed</source>
            <translation type="unfinished">{name} est de forme {array_shape} ; il faut (7,)</translation>
        </message>
        <message>
            <source>{name} is not finite: {array}</source>
            <translation type="unfinished">{name} n’est pas fini : {array}</translation>
        </message>
        <message>
            <source>wrist centre ({x:.6g}, {y:.6g}, {z:.6g}) m is {reach:.6g} m from the shoulder; the links span {least:.4g} to {most:.4g} m</source>
            <translation type="unfinished">le centre du poignet ({x:.6g}, {y:.6g}, {z:.6g}) m est à {reach:.6g} m de l’épaule ; les segments couvrent de {least:.4g} à {most:.4g} m</translation>
        </message>
        <message>
            <source>{refusal}; nearest_pose gives the nearest that is within the joint limits</source>
            <translation type="unfinished">{refusal} ; nearest_pose donne la plus proche dans les limites articulaires</translation>
        </message>
        <message>
            <source>{refusal}; the nearest that they reach is ({x:.4f}, {y:.4f}, {z:.4f}) m (nearest_pose)</source>
            <translation type="unfinished">{refusal} ; le lieu atteignable le plus proche est ({x:.4f}, {y:.4f}, {z:.4f}) m (nearest_pose)</translation>
        </message>
        <message>
            <source>arm {name}: {quantity} is {length} m; a positive length is needed</source>
            <translation type="unfinished">bras {name} : {quantity} vaut {length} m ; il faut une longueur positive</translation>
        </message>
        <message>
            <source>arm {name}: limits {lower} to {upper} rad; every joint must turn both ways from zero</source>
            <translation type="unfinished">bras {name} : limites de {lower} à {upper} rad ; chaque articulation doit tourner dans les deux sens depuis zéro</translation>
        </message>
        <message>
            <source>no arm {name_or_path!r}; there is iiwa14, or the path of a .yaml file</source>
            <translation type="unfinished">pas de bras {name_or_path!r} ; il y a iiwa14, ou le chemin d’un fichier .yaml</translation>
        </message>
        <message>
            <source>no published description of arm {name!r}; there is iiwa14</source>
            <translation type="unfinished">pas de description publiée du bras {name!r} ; il y a iiwa14</translation>
        </message>
        <message>
            <source>joint {joint} would stand {margin_deg:.3g}° beyond its limits, at the best arm angle tried: {in_words}</source>
            <translation type="unfinished">l’articulation {joint} serait {margin_deg:.3g}° au-delà de ses limites, au meilleur angle de bras essayé : {in_words}</translation>
        </message>
        <message>
            <source>no arc: the start is {radius:.6g} m from the axis and {up:.6g} m along it, the end {its:.6g} m and {other:.6g} m; both must be alike, and off the axis</source>
            <translation type="unfinished">pas d’arc : le début est à {radius:.6g} m de l’axe et {up:.6g} m le long de celui-ci, la fin à {its:.6g} m et {other:.6g} m ; les deux doivent être pareils, et hors de l’axe</translation>
        </message>
        <message>
            <source>tips have shape {tips_shape}; (n, 3) with two or more are needed</source>
            <translation type="unfinished">les pointes sont de forme {tips_shape} ; il faut (n, 3), avec deux ou plus</translation>
        </message>
        <message>
            <source>a sweep has two places of the tip that follow and are the same</source>
            <translation type="unfinished">un balayage a deux positions successives de la pointe identiques</translation>
        </message>
        <message>
            <source>the arm gets {share:.3g} % of the way, to ({x:.4g}, {y:.4g}, {z:.4g}) m: {reason}</source>
            <translation type="unfinished">le bras parcourt {share:.3g} % du chemin, jusqu’à ({x:.4g}, {y:.4g}, {z:.4g}) m : {reason}</translation>
        </message>
        <message>
            <source>; with its base at ({x:.4g}, {y:.4g}, {z:.4g}) m it could</source>
            <translation type="unfinished">; avec sa base en ({x:.4g}, {y:.4g}, {z:.4g}) m, il le pourrait</translation>
        </message>
        <message>
            <source>; no base within {away:g} m of where it stands was found that could</source>
            <translation type="unfinished">; aucune base qui le permette n’a été trouvée à moins de {away:g} m d’où il est</translation>
        </message>
        <message>
            <source>the last count returns or raises</source>
            <translation type="unfinished">le dernier nombre renvoie ou lève une exception</translation>
        </message>
        <message>
            <source>joint {joint} stands {step_deg:.3g}° from the posture that the motion begins with</source>
            <translation type="unfinished">l’articulation {joint} est à {step_deg:.3g}° de la posture où commence le mouvement</translation>
        </message>
        <message>
            <source>joint {joint} would jump by {step_deg:.3g}°: to go on it needs another posture</source>
            <translation type="unfinished">l’articulation {joint} sauterait de {step_deg:.3g}° : pour continuer, il faut une autre posture</translation>
        </message>
        <message>
            <source>the shaft would pass the fulcrum at {off_mm:.3g} mm</source>
            <translation type="unfinished">la tige passerait à {off_mm:.3g} mm du point de pivot</translation>
        </message>
        <message>
            <source>its dexterity falls to {dexterity:.2g} ({names}); {least_dexterity:g} is the least</source>
            <translation type="unfinished">sa dextérité tombe à {dexterity:.2g} ({names}) ; le minimum est {least_dexterity:g}</translation>
        </message>
        <message>
            <source>a joint would pass its limit between two postures</source>
            <translation type="unfinished">une articulation dépasserait sa limite entre deux postures</translation>
        </message>
        <message>
            <source>a path needs two knots or more, ascending; s is {s}</source>
            <translation type="unfinished">un chemin demande deux nœuds ou plus, croissants ; s vaut {s}</translation>
        </message>
        <message>
            <source>no grip brings the tool into the trocar: {tried}</source>
            <translation type="unfinished">aucune prise n’amène l’instrument dans le trocart : {tried}</translation>
        </message>
        <message>
            <source>{grip}: {reason}</source>
            <translation type="unfinished">{grip} : {reason}</translation>
        </message>
        <message>
            <source>{phase}: {reason}</source>
            <translation type="unfinished">{phase} : {reason}</translation>
        </message>
        <message>
            <source>{collision} after {share:.0f} %</source>
            <translation type="unfinished">{collision} après {share:.0f} %</translation>
        </message>
        <message>
            <source>{things_touched} at its end</source>
            <translation type="unfinished">{things_touched} à la fin</translation>
        </message>
        <message>
            <source>the tool of {length} m is gripped {grip} m from its tip; grip it on its length</source>
            <translation type="unfinished">l’instrument de {length} m est saisi à {grip} m de sa pointe ; saisissez-le sur sa longueur</translation>
        </message>
        <message>
            <source>largest tilt of the shaft is {tilt_deg}°; it must be within (0°, 90°)</source>
            <translation type="unfinished">la plus grande inclinaison de la tige est de {tilt_deg}° ; elle doit être entre 0° et 90°</translation>
        </message>
        <message>
            <source>the tip is {depth_mm:.3g} mm from the fulcrum: there it has no direction, and its scale no value; from {least_depth_mm:g} mm on it has, nearer the tool is slid along a given one</source>
            <translation type="unfinished">la pointe est à {depth_mm:.3g} mm du point de pivot : elle n’y a pas de direction, et son échelle pas de valeur ; elle en a à partir de {least_depth_mm:g} mm, plus près l’instrument coulisse selon une direction donnée</translation>
        </message>
        <message>
            <source>the shaft would lean {tilt_deg:.4g}° from the trocar's axis; it grazes beyond {largest_tilt_deg:.4g}°</source>
            <translation type="unfinished">la tige serait inclinée de {tilt_deg:.4g}° par rapport à l’axe du trocart ; elle frotte au-delà de {largest_tilt_deg:.4g}°</translation>
        </message>
        <message>
            <source>at a depth of {depth_mm:.4g} mm the grip would be {outside_mm:.4g} mm from the fulcrum; at least {clearance_mm:.4g} mm are needed: grip the tool further back</source>
            <translation type="unfinished">à une profondeur de {depth_mm:.4g} mm, la prise serait à {outside_mm:.4g} mm du point de pivot ; il en faut au moins {clearance_mm:.4g} mm : saisissez l’instrument plus en arrière</translation>
        </message>
        <message>
            <source>the arm's dexterity is {dexterity:.2g} with the tool rolled by {roll_deg:.0f}°; holding needs {least_dexterity:g}</source>
            <translation type="unfinished">la dextérité du bras est de {dexterity:.2g} avec l’instrument roulé de {roll_deg:.0f}° ; tenir demande {least_dexterity:g}</translation>
        </message>
        <message>
            <source>the arm's dexterity is {seen_dexterity:.2g} ({names}); rates need {least_dexterity:g}: plan around it</source>
            <translation type="unfinished">la dextérité du bras est de {seen_dexterity:.2g} ({names}) ; les vitesses demandent {least_dexterity:g} : contournez cette zone</translation>
        </message>
        <message>
            <source>the arm touches something</source>
            <translation type="unfinished">le bras touche quelque chose</translation>
        </message>
        <message>
            <source>the {name} has a joint {excess:.3g} rad beyond</source>
            <translation type="unfinished">{name} : une articulation dépasse de {excess:.3g} rad</translation>
        </message>
        <message>
            <source>the arm touches something at the {name}: begin and end where it is free</source>
            <translation type="unfinished">le bras touche quelque chose à {name} : commencez et finissez là où il est libre</translation>
        </message>
        <message>
            <source>start and goal are the same posture: there is nothing to move</source>
            <translation type="unfinished">départ et arrivée sont la même posture : il n’y a rien à déplacer</translation>
        </message>
        <message>
            <source>with the tip at the {name} the arm touches something, or has no posture</source>
            <translation type="unfinished">avec la pointe à {name}, le bras touche quelque chose, ou n’a pas de posture</translation>
        </message>
        <message>
            <source>the tip is where it shall go: there is nothing to move</source>
            <translation type="unfinished">la pointe est déjà là où elle doit aller : il n’y a rien à déplacer</translation>
        </message>
        <message>
            <source>{attempts} ways of the tip were found, but the arm's postures along them touch something: begin with another posture or roll</source>
            <translation type="unfinished">chemins trouvés pour la pointe : {attempts}, mais les postures du bras y touchent quelque chose : commencez par une autre posture ou un autre roulis</translation>
        </message>
        <message>
            <source>{planner} found no way in {time_perf_counter:.3g} s and {tests} tests (budget {budget_seconds:g} s, {budget_tests} tests, seed {budget_seed}): give it more, or make room</source>
            <translation type="unfinished">{planner} n’a trouvé aucun chemin en {time_perf_counter:.3g} s et {tests} tests (budget {budget_seconds:g} s, {budget_tests} tests, graine {budget_seed}) : donnez-lui plus, ou faites de la place</translation>
        </message>
        <message>
            <source>a scale of {scale} was asked for; it must be in (0, 1]</source>
            <translation type="unfinished">une échelle de {scale} a été demandée ; elle doit être dans ]0, 1]</translation>
        </message>
        <message>
            <source>the path does not move: it has one posture only</source>
            <translation type="unfinished">le chemin ne bouge pas : il n’a qu’une posture</translation>
        </message>
        <message>
            <source>Ruckig finds no motion: {answer}</source>
            <translation type="unfinished">Ruckig ne trouve aucun mouvement : {answer}</translation>
        </message>
        <message>
            <source>the eyes find no tool: {reason}</source>
            <translation type="unfinished">les yeux ne trouvent pas d’instrument : {reason}</translation>
        </message>
        <message>
            <source>the eyes do not know where the tool lies: {reason}</source>
            <translation type="unfinished">les yeux ne savent pas où se trouve l’instrument : {reason}</translation>
        </message>
        <message>
            <source>the eyes know the tool's place to {known_mm:.1f} mm only, {sure_mm:g} mm are needed; turn the tool, or move a camera out of its line</source>
            <translation type="unfinished">les yeux ne connaissent la position de l’instrument qu’à {known_mm:.1f} mm près, il faut {sure_mm:g} mm ; tournez l’instrument, ou écartez une caméra de sa ligne</translation>
        </message>
        <message>
            <source>the eyes find no trocar: {ring_status}; let arm and cameras stand elsewhere round it</source>
            <translation type="unfinished">les yeux ne trouvent pas de trocart : {ring_status} ; placez le bras et les caméras ailleurs autour de lui</translation>
        </message>
        <message>
            <source>the arm would have to insert its tool by {deep_mm:.0f} mm; up to {deepest_mm:.0f} mm it can: choose an entry nearer to the target</source>
            <translation type="unfinished">le bras devrait introduire son instrument de {deep_mm:.0f} mm ; il peut aller jusqu’à {deepest_mm:.0f} mm : choisissez un point d’entrée plus proche de la cible</translation>
        </message>
        <message>
            <source>the path leans {placed_tilt_deg:.0f}° from straight down; the arm inserts up to {flattest_deg:.0f}°: turn the patient, or choose a steeper path</source>
            <translation type="unfinished">la trajectoire s’écarte de {placed_tilt_deg:.0f}° de la verticale ; le bras introduit jusqu’à {flattest_deg:.0f}° : tournez le patient, ou choisissez une trajectoire plus raide</translation>
        </message>
        <message>
            <source>insertion: depth is {depth} m; give more than 0</source>
            <translation type="unfinished">introduction : depth vaut {depth} m ; donnez plus de 0</translation>
        </message>
        <message>
            <source>the path leans {lean:.0f}° from the trocar's axis, which leaves a gap of {gap_mm:.1f} mm round the shaft; {room_mm:g} mm are needed: lay the trocar for this path</source>
            <translation type="unfinished">la trajectoire s’écarte de {lean:.0f}° de l’axe du trocart, ce qui laisse un jeu de {gap_mm:.1f} mm autour de la tige ; il faut {room_mm:g} mm : posez le trocart pour cette trajectoire</translation>
        </message>
        <message>
            <source>the arm cannot {doing}: {error}; let it stand elsewhere round the entry or choose another path</source>
            <translation type="unfinished">le bras échoue à l’étape « {doing} » : {error} ; placez-le ailleurs autour du point d’entrée ou choisissez une autre trajectoire</translation>
        </message>
        <message>
            <source>the tool is not in the trocar: its axis passes {aside_mm:.1f} mm from the ring's centre, its tip is {depth_mm:.0f} mm beyond it; look again, and grasp the tool anew</source>
            <translation type="unfinished">l’instrument n’est pas dans le trocart : son axe passe à {aside_mm:.1f} mm du centre de l’anneau, sa pointe est {depth_mm:.0f} mm au-delà ; regardez à nouveau, et ressaisissez l’instrument</translation>
        </message>
        <message>
            <source>the shaft pressed the trocar's ring with {pressed:.1f} N; up to {allowed:g} N are allowed: look again, or lay the trocar for this path</source>
            <translation type="unfinished">la tige a appuyé sur l’anneau du trocart avec {pressed:.1f} N ; {allowed:g} N au plus sont permis : regardez à nouveau, ou posez le trocart pour cette trajectoire</translation>
        </message>
        <message>
            <source>the tool has fallen: no finger touches it; grasp more firmly</source>
            <translation type="unfinished">l’instrument est tombé : aucun doigt ne le touche ; serrez plus fort</translation>
        </message>
        <message>
            <source>the tool moved by {moved_mm:.2g} mm and {turned_deg:.2g}° in the hand; up to {slip_mm:g} mm and {slip_turn_deg:g}° are allowed: grasp more firmly</source>
            <translation type="unfinished">l’instrument a bougé de {moved_mm:.2g} mm et {turned_deg:.2g}° dans la main ; au plus {slip_mm:g} mm et {slip_turn_deg:g}° sont permis : serrez plus fort</translation>
        </message>
        <message>
            <source>scene of the arm: {name} is {length}; give more than 0</source>
            <translation type="unfinished">scène du bras : {name} vaut {length} ; donnez plus de 0</translation>
        </message>
        <message>
            <source>scene of the arm: home {home_deg}° is beyond the joint limits ±{limits_deg}°</source>
            <translation type="unfinished">scène du bras : home {home_deg}° dépasse les limites articulaires ±{limits_deg}°</translation>
        </message>
        <message>
            <source>scene of the arm: the trocar at ({x:.0f}, {y:.0f}) mm does not lie on the skin, {on_first_low} to {on_first_high} m</source>
            <translation type="unfinished">scène du bras : le trocart en ({x:.0f}, {y:.0f}) mm n’est pas sur la peau, de {on_first_low} à {on_first_high} m</translation>
        </message>
        <message>
            <source>timeline of the arm: {name} has shape {values_shape} or is not finite; {count} finite numbers are needed</source>
            <translation type="unfinished">chronologie du bras : {name} est de forme {values_shape} ou n’est pas fini ; il faut {count} nombres finis</translation>
        </message>
        <message>
            <source>timeline of the arm: its time must rise, over two moments or more</source>
            <translation type="unfinished">chronologie du bras : son temps doit croître, sur deux instants ou plus</translation>
        </message>
        <message>
            <source>timeline of the arm: phase and held need one entry a moment</source>
            <translation type="unfinished">chronologie du bras : phase et held demandent une entrée par instant</translation>
        </message>
        <message>
            <source>timeline of the arm: phases must go through {names} in order</source>
            <translation type="unfinished">chronologie du bras : les phases doivent parcourir {names} dans l’ordre</translation>
        </message>
        <message>
            <source>the arm has no phase {name!r}; there are {there}</source>
            <translation type="unfinished">le bras n’a pas de phase {name!r} ; il y a {there}</translation>
        </message>
        <message>
            <source>the path takes joint {k} {beyond_max_deg:.3g}° beyond its limits</source>
            <translation type="unfinished">le chemin mène l’articulation {k} {beyond_max_deg:.3g}° au-delà de ses limites</translation>
        </message>
        <message>
            <source>the hand does not hold the tool after {patience:g} s: {have}</source>
            <translation type="unfinished">la main ne tient pas l’instrument après {patience:g} s : {have}</translation>
        </message>
        <message>
            <source>MuJoCo cannot draw without a display here ({error}); install EGL (libegl1), or set MUJOCO_GL=osmesa</source>
            <translation type="unfinished">MuJoCo ne peut pas dessiner ici sans écran ({error}) ; installez EGL (libegl1), ou définissez MUJOCO_GL=osmesa</translation>
        </message>
        <message>
            <source>the scene of the arm is not open; call open() first</source>
            <translation type="unfinished">la scène du bras n’est pas ouverte ; appelez d’abord open()</translation>
        </message>
        <message>
            <source>it was loaded for a display, and there is none</source>
            <translation type="unfinished">il a été chargé pour un écran, et il n’y en a pas</translation>
        </message>
        <message>
            <source>MuJoCo refuses the scene of the arm: {error}</source>
            <translation type="unfinished">MuJoCo refuse la scène du bras : {error}</translation>
        </message>
        <message>
            <source>{kind}, {distance:g} rad</source>
            <translation type="unfinished">{kind}, {distance:g} rad</translation>
        </message>
        <message>
            <source>searches</source>
            <translation type="unfinished">recherches</translation>
        </message>
        <message>
            <source>no fulcrum: {result_status}; turn the tool further</source>
            <translation type="unfinished">pas de point de pivot : {result_status} ; tournez davantage l’instrument</translation>
        </message>
        <message>
            <source>no trocar: {status}</source>
            <translation type="unfinished">pas de trocart : {status}</translation>
        </message>
        <message>
            <source>EAIK is not installed: pip install EAIK, beside Acus</source>
            <translation type="unfinished">EAIK n’est pas installé : pip install EAIK, à côté d’Acus</translation>
        </message>
        <message>
            <source>What the arm does</source>
            <translation type="unfinished">Ce que fait le bras</translation>
        </message>
        <message>
            <source>Pause (Space)</source>
            <translation type="unfinished">Pause (Espace)</translation>
        </message>
        <message>
            <source>Step (F10)</source>
            <translation type="unfinished">Pas à pas (F10)</translation>
        </message>
        <message>
            <source>To the entry (F3)</source>
            <translation type="unfinished">Au point d’entrée (F3)</translation>
        </message>
        <message>
            <source>Take over (F12)</source>
            <translation type="unfinished">Reprendre la main (F12)</translation>
        </message>
        <message>
            <source>Stop (Esc)</source>
            <translation type="unfinished">Arrêter (Échap)</translation>
        </message>
        <message>
            <source>The arm stands still, the needle where it is; or it goes on</source>
            <translation type="unfinished">Le bras s’immobilise, l’aiguille reste où elle est ; ou bien il continue</translation>
        </message>
        <message>
            <source>The arm goes on for half a second, then stands still</source>
            <translation type="unfinished">Le bras continue une demi-seconde, puis s’immobilise</translation>
        </message>
        <message>
            <source>Leave out the rest of the fetching: the arm stands over the entry</source>
            <translation type="unfinished">Saute la suite de la préparation : le bras se place au-dessus du point d’entrée</translation>
        </message>
        <message>
            <source>You go on with mouse or keys from where the needle is now</source>
            <translation type="unfinished">Vous continuez à la souris ou au clavier, là où se trouve l’aiguille</translation>
        </message>
        <message>
            <source>The attempt is broken off; everything is as it was before</source>
            <translation type="unfinished">L’essai est abandonné ; tout redevient comme avant</translation>
        </message>
        <message>
            <source>Go on (Space)</source>
            <translation type="unfinished">Continuer (Espace)</translation>
        </message>
        <message>
            <source>Simulated arm: robot and cameras are coming …</source>
            <translation type="unfinished">Bras simulé : démarrage du robot et des caméras …</translation>
        </message>
        <message>
            <source>Simulated arm: stopping …</source>
            <translation type="unfinished">Bras simulé : arrêt en cours …</translation>
        </message>
        <message>
            <source>holds still at your target</source>
            <translation type="unfinished">reste immobile sur votre cible</translation>
        </message>
        <message>
            <source>Simulated arm: {what}  ·  {now:.0f}/{all:.0f} s</source>
            <translation type="unfinished">Bras simulé : {what}  ·  {now:.0f}/{all:.0f} s</translation>
        </message>
        <message>
            <source>Simulated arm  ‖  {what}  ·  {now:.0f}/{all:.0f} s</source>
            <translation type="unfinished">Bras simulé  ‖  {what}  ·  {now:.0f}/{all:.0f} s</translation>
        </message>
        <message>
            <source>A simulation only: it drives no real arm and no real robot.</source>
            <translation type="unfinished">Simple simulation : elle ne commande ni vrai bras ni vrai robot.</translation>
        </message>
        <message>
            <source>reaches for the needle guide</source>
            <translation type="unfinished">tend la main vers le guide-aiguille</translation>
        </message>
        <message>
            <source>closes its hand</source>
            <translation type="unfinished">ferme la main</translation>
        </message>
        <message>
            <source>lifts the guide off the tray</source>
            <translation type="unfinished">soulève le guide du plateau</translation>
        </message>
        <message>
            <source>brings it to the entry</source>
            <translation type="unfinished">l’amène au point d’entrée</translation>
        </message>
        <message>
            <source>stands it over the entry</source>
            <translation type="unfinished">le place au-dessus du point d’entrée</translation>
        </message>
        <message>
            <source>turns the needle to your path</source>
            <translation type="unfinished">oriente l’aiguille sur votre trajectoire</translation>
        </message>
        <message>
            <source>inserts along your path</source>
            <translation type="unfinished">introduit le long de votre trajectoire</translation>
        </message>
        <message>
            <source>Start waits: the arm has the needle. Esc stops it.</source>
            <translation type="unfinished">Départ en attente : le bras tient l’aiguille. Échap l’arrête.</translation>
        </message>
        <message>
            <source>The arm stopped: another robot or exercise was taken.</source>
            <translation type="unfinished">Le bras s’est arrêté : un autre robot ou exercice a été choisi.</translation>
        </message>
        <message>
            <source>The arm stopped: the plan was changed. Ask again for the new one.</source>
            <translation type="unfinished">Le bras s’est arrêté : le plan a été modifié. Redemandez-le pour le nouveau plan.</translation>
        </message>
        <message>
            <source>{name}: {answer!r} are not numbers between commas, e.g. 20.5,51,102</source>
            <translation type="unfinished">{name} : {answer!r} n’est pas une suite de nombres séparés par des virgules, p. ex. 20.5,51,102</translation>
        </message>
        <message>
            <source>{name}: {count} finite numbers are needed, got {answer!r}</source>
            <translation type="unfinished">{name} : il faut {count} nombres finis, reçu {answer!r}</translation>
        </message>
        <message>
            <source>{routine_title}: {report_needs}: give it with --readings</source>
            <translation type="unfinished">{routine_title} : {report_needs} : donnez-le avec --readings</translation>
        </message>
        <message>
            <source>the input has ended before the routine; nothing was kept</source>
            <translation type="unfinished">l’entrée s’est terminée avant la routine ; rien n’a été gardé</translation>
        </message>
        <message>
            <source>--at {place!r} is not {pose}: millimetres and degrees, e.g. -60,180,90,180,0,0</source>
            <translation type="unfinished">--at {place!r} n’est pas {pose} : millimètres et degrés, p. ex. -60,180,90,180,0,0</translation>
        </message>
        <message>
            <source>no calibration is in use: run `acus calibrate stereo --keep` first, or name one with --calibration</source>
            <translation type="unfinished">aucun étalonnage n’est utilisé : exécutez d’abord `acus calibrate stereo --keep`, ou indiquez-en un avec --calibration</translation>
        </message>
        <message>
            <source>--out takes the lens of one camera; these pictures are of {groups}: give a folder for each, or use `acus calibrate stereo`</source>
            <translation type="unfinished">--out prend l’objectif d’une seule caméra ; ces images sont de {groups} : donnez un dossier pour chacune, ou utilisez `acus calibrate stereo`</translation>
        </message>
        <message>
            <source>name the folder of the pictures: --images DIR</source>
            <translation type="unfinished">indiquez le dossier des images : --images DIR</translation>
        </message>
        <message>
            <source>name the pictures: either --images DIR, or --left and --right</source>
            <translation type="unfinished">indiquez les images : soit --images DIR, soit --left et --right</translation>
        </message>
        <message>
            <source>--check-images DIR and --check-board SPEC go together; give both</source>
            <translation type="unfinished">--check-images DIR et --check-board SPEC vont ensemble ; donnez les deux</translation>
        </message>
        <message>
            <source>--names {names!r} is not two names, e.g. left,right</source>
            <translation type="unfinished">--names {names!r} n’est pas deux noms, p. ex. left,right</translation>
        </message>
        <message>
            <source>--format {kind}: only yaml and ros can be written</source>
            <translation type="unfinished">--format {kind} : seuls yaml et ros peuvent être écrits</translation>
        </message>
        <message>
            <source>--out {out}: only .pdf can be written</source>
            <translation type="unfinished">--out {out} : seul .pdf peut être écrit</translation>
        </message>
        <message>
            <source>--lens {lens!r}: there are {known_lenses}; equidistant is the fisheye model</source>
            <translation type="unfinished">--lens {lens!r} : il y a {known_lenses} ; equidistant est le modèle fisheye</translation>
        </message>
        <message>
            <source>{depths!r} is no range of depths; give for example -30,120</source>
            <translation type="unfinished">{depths!r} n’est pas un intervalle de profondeurs ; donnez par exemple -30,120</translation>
        </message>
        <message>
            <source>{size!r} is no size of a picture; give for example 640x480</source>
            <translation type="unfinished">{size!r} n’est pas une taille d’image ; donnez par exemple 640x480</translation>
        </message>
        <message>
            <source>there is no {side!r} camera; there are {sides}</source>
            <translation type="unfinished">il n’y a pas de caméra {side!r} ; il y a {sides}</translation>
        </message>
        <message>
            <source>the cameras are simulated and have no latency to measure; choose real ones with `acus camera use`</source>
            <translation type="unfinished">les caméras sont simulées et n’ont pas de latence à mesurer ; choisissez-en de vraies avec `acus camera use`</translation>
        </message>
        <message>
            <source>the test needs a real screen that a camera can look at; there is none</source>
            <translation type="unfinished">le test demande un vrai écran qu’une caméra puisse voir ; il n’y en a pas</translation>
        </message>
        <message>
            <source>name a point: either --voxel I,J,K, or --sop UID with --pixel COL,ROW</source>
            <translation type="unfinished">indiquez un point : soit --voxel I,J,K, soit --sop UID avec --pixel COL,ROW</translation>
        </message>
        <message>
            <source>--frame {frame}: frames count from 1 and go with --sop UID</source>
            <translation type="unfinished">--frame {frame} : les images se comptent à partir de 1 et vont avec --sop UID</translation>
        </message>
        <message>
            <source>--remedy goes with --voxel; a pixel lies where its file puts it</source>
            <translation type="unfinished">--remedy va avec --voxel ; un pixel est là où son fichier le place</translation>
        </message>
        <message>
            <source>--sop UID and --pixel COL,ROW go together; give both</source>
            <translation type="unfinished">--sop UID et --pixel COL,ROW vont ensemble ; donnez les deux</translation>
        </message>
        <message>
            <source>{option} {point!r}: three numbers X,Y,Z in mm</source>
            <translation type="unfinished">{option} {point!r} : trois nombres X,Y,Z en mm</translation>
        </message>
        <message>
            <source>--remedy {remedy!r} is none of {valid}</source>
            <translation type="unfinished">--remedy {remedy!r} n’est aucun de {valid}</translation>
        </message>
        <message>
            <source>--mask {mask!r} is not COL,ROW,WIDTH,HEIGHT or COL,ROW,WIDTH,HEIGHT,PICTURE: four or five whole numbers, no blanks</source>
            <translation type="unfinished">--mask {mask!r} n’est pas COL,ROW,WIDTH,HEIGHT ni COL,ROW,WIDTH,HEIGHT,PICTURE : quatre ou cinq nombres entiers, sans espaces</translation>
        </message>
        <message>
            <source>voxel {ijk} is outside the series: {limits}</source>
            <translation type="unfinished">le voxel {ijk} est hors de la série : {limits}</translation>
        </message>
        <message>
            <source>{option} {argument!r} is not {form}: {count} whole numbers, no blanks</source>
            <translation type="unfinished">{option} {argument!r} n’est pas {form} : {count} nombres entiers, sans espaces</translation>
        </message>
        <message>
            <source>the robot was greeted but sends no joint angles; see `acus device test`</source>
            <translation type="unfinished">le robot a répondu mais n’envoie pas d’angles articulaires ; voir `acus device test`</translation>
        </message>
        <message>
            <source>--ct DIR needs --plan FILE: entry and target lie in that CT</source>
            <translation type="unfinished">--ct DIR demande --plan FILE : le point d’entrée et la cible sont dans ce CT</translation>
        </message>
        <message>
            <source>there is no script {script!r}; there are {scripts}</source>
            <translation type="unfinished">il n’y a pas de script {script!r} ; il y a {scripts}</translation>
        </message>
        <message>
            <source>--target {target}: three numbers X,Y,Z in mm are needed</source>
            <translation type="unfinished">--target {target} : il faut trois nombres X,Y,Z en mm</translation>
        </message>
        <message>
            <source>{form}: the forms are {forms}</source>
            <translation type="unfinished">{form} : les formes sont {forms}</translation>
        </message>
        <message>
            <source>--student is for pdf; the tables hold everybody</source>
            <translation type="unfinished">--student vaut pour pdf ; les tableaux contiennent tout le monde</translation>
        </message>
        <message>
            <source>--ct {ct} does not exist; name a folder or file with a CT</source>
            <translation type="unfinished">--ct {ct} n’existe pas ; indiquez un dossier ou un fichier avec un CT</translation>
        </message>
        <message>
            <source>--out {out}: only .csv can be written</source>
            <translation type="unfinished">--out {out} : seul .csv peut être écrit</translation>
        </message>
        <message>
            <source>--trajectory takes exactly one session id</source>
            <translation type="unfinished">--trajectory demande exactement un identifiant de séance</translation>
        </message>
        <message>
            <source>study {name} takes no --{option}; leave it out</source>
            <translation type="unfinished">l’étude {name} n’accepte pas --{option} ; omettez-le</translation>
        </message>
        <message>
            <source>--orientation {orientation!r}: use {valid}</source>
            <translation type="unfinished">--orientation {orientation!r} : utilisez {valid}</translation>
        </message>
        <message>
            <source>--origin {origin!r}; valid names: {names}</source>
            <translation type="unfinished">--origin {origin!r} ; noms valides : {names}</translation>
        </message>
        <message>
            <source>--out {out}: a device profile is a .yaml file</source>
            <translation type="unfinished">--out {out} : un profil d’appareil est un fichier .yaml</translation>
        </message>
        <message>
            <source>exercise {name} has no CT in Hounsfield values: nothing tells what its needle meets</source>
            <translation type="unfinished">l’exercice {name} n’a pas de CT en valeurs Hounsfield : rien ne dit ce que rencontre son aiguille</translation>
        </message>
        <message>
            <source>the cameras are simulated; choose real ones with `acus camera use --left SOURCE --right SOURCE`, or look at one with --source</source>
            <translation type="unfinished">les caméras sont simulées ; choisissez-en de vraies avec `acus camera use --left SOURCE --right SOURCE`, ou regardez-en une avec --source</translation>
        </message>
        <message>
            <source>left and right are not checked: there is no calibration yet (`acus calibrate`)</source>
            <translation type="unfinished">gauche et droite ne sont pas vérifiées : il n’y a pas encore d’étalonnage (`acus calibrate`)</translation>
        </message>
        <message>
            <source>rig {rig_name} as designed</source>
            <translation type="unfinished">montage {rig_name} tel que conçu</translation>
        </message>
        <message>
            <source>calibration {name}</source>
            <translation type="unfinished">étalonnage {name}</translation>
        </message>
        <message>
            <source>{basis}; the cameras are not calibrated with a world frame yet</source>
            <translation type="unfinished">{basis} ; les caméras ne sont pas encore étalonnées avec un repère monde</translation>
        </message>
        <message>
            <source>the cameras are not calibrated: run `acus calibrate stereo` and `acus calibrate world`, or choose the calibration in the window's menu Cameras</source>
            <translation type="unfinished">les caméras ne sont pas étalonnées : exécutez `acus calibrate stereo` et `acus calibrate world`, ou choisissez l’étalonnage dans le menu Caméras de la fenêtre</translation>
        </message>
        <message>
            <source>calibration {calibration_id} was found bad ({reason}); calibrate again, or choose another one in the camera settings</source>
            <translation type="unfinished">l’étalonnage {calibration_id} a été jugé mauvais ({reason}) ; étalonnez à nouveau, ou choisissez-en un autre dans les réglages des caméras</translation>
        </message>
        <message>
            <source>the check is not open: call open() first</source>
            <translation type="unfinished">la vérification n’est pas ouverte : appelez d’abord open()</translation>
        </message>
        <message>
            <source>plate {plate_name} has no known place in the robot's frame; give `place` in its file</source>
            <translation type="unfinished">la plaque {plate_name} n’a pas de place connue dans le repère du robot ; donnez `place` dans son fichier</translation>
        </message>
        <message>
            <source>view {name!r} is declared twice: {files} and {path}</source>
            <translation type="unfinished">la vue {name!r} est déclarée deux fois : {files} et {path}</translation>
        </message>
        <message>
            <source>asking the camera for its first picture</source>
            <translation type="unfinished">demande de la première image à la caméra</translation>
        </message>
        <message>
            <source>computing what the cameras see of the needle's cone</source>
            <translation type="unfinished">calcul de ce que les caméras voient du cône de l’aiguille</translation>
        </message>
        <message>
            <source>asking the webcam for its first picture</source>
            <translation type="unfinished">demande de la première image à la webcam</translation>
        </message>
        <message>
            <source>compiling the loop</source>
            <translation type="unfinished">compilation de la boucle de commande</translation>
        </message>
        <message>
            <source>starting robot and cameras</source>
            <translation type="unfinished">démarrage du robot et des caméras</translation>
        </message>
        <message>
            <source>the control loop has not ticked in {waited:.0f} s; start it again</source>
            <translation type="unfinished">la boucle de commande n’a pas tourné depuis {waited:.0f} s ; relancez-la</translation>
        </message>
        <message>
            <source>exercise {exercise_id} has no effect {effect!r}; it has {exercise_effects}</source>
            <translation type="unfinished">l’exercice {exercise_id} n’a pas d’effet {effect!r} ; il a {exercise_effects}</translation>
        </message>
        <message>
            <source>effect {effect} acts on the pictures of cameras that are running: choose its model in the exercise, before the attempt</source>
            <translation type="unfinished">l’effet {effect} agit sur les images de caméras en marche : choisissez son modèle dans l’exercice, avant l’essai</translation>
        </message>
        <message>
            <source>{link} exists and is not a link; choose another --link</source>
            <translation type="unfinished">{link} existe et n’est pas un lien ; choisissez un autre --link</translation>
        </message>
        <message>
            <source>no link can be made in {link_parent}; choose another --link</source>
            <translation type="unfinished">impossible de créer un lien dans {link_parent} ; choisissez un autre --link</translation>
        </message>
        <message>
            <source>this system has no pseudo-terminals (Windows): the emulated board runs on Linux</source>
            <translation type="unfinished">ce système n’a pas de pseudo-terminaux (Windows) : la carte émulée tourne sous Linux</translation>
        </message>
        <message>
            <source>no hand {name!r}; valid names: {hands}</source>
            <translation type="unfinished">pas de main {name!r} ; noms valides : {hands}</translation>
        </message>
        <message>
            <source>{order!r} is not understood; valid are: hold on|off, turn left|right DEGREES, lean X Y (degrees towards x and y)</source>
            <translation type="unfinished">{order!r} n’est pas compris ; sont valides : hold on|off, turn left|right DEGREES, lean X Y (degrés vers x et y)</translation>
        </message>
        <message>
            <source>the needle would lean by more than {largest_tilt:g} degrees; turn by less</source>
            <translation type="unfinished">l’aiguille pencherait de plus de {largest_tilt:g} degrés ; tournez moins</translation>
        </message>
        <message>
            <source>{angle!r} is no number of degrees</source>
            <translation type="unfinished">{angle!r} n’est pas un nombre de degrés</translation>
        </message>
        <message>
            <source>{angle} degrees is too much; give at most {largest_tilt:g}</source>
            <translation type="unfinished">{angle} degrés, c’est trop ; donnez au plus {largest_tilt:g}</translation>
        </message>
        <message>
            <source>no hand {hand!r}; valid names: {hands}</source>
            <translation type="unfinished">pas de main {hand!r} ; noms valides : {hands}</translation>
        </message>
        <message>
            <source>no fault or order {name!r}; valid names: {valid}</source>
            <translation type="unfinished">ni défaut ni ordre {name!r} ; sont valides : {valid}</translation>
        </message>
        <message>
            <source>fault {name} needs a number, e.g. `{name} 1`</source>
            <translation type="unfinished">le défaut {name} demande un nombre, p. ex. `{name} 1`</translation>
        </message>
        <message>
            <source>fault {name}: {setting!r} is no number, on or off</source>
            <translation type="unfinished">défaut {name} : {setting!r} n’est ni un nombre, ni on, ni off</translation>
        </message>
        <message>
            <source>exercise {exercise_id} has structures of risk, and no CT to place them on: open it</source>
            <translation type="unfinished">l’exercice {exercise_id} a des structures à risque, mais pas de CT où les placer : ouvrez-le</translation>
        </message>
        <message>
            <source>layers: the exercise has them</source>
            <translation type="unfinished">couches : l’exercice en a</translation>
        </message>
        <message>
            <source>the field: the exercise asks for it</source>
            <translation type="unfinished">le champ : l’exercice le demande</translation>
        </message>
        <message>
            <source>exercise {exercise_id} has tissue: field, and its CT is not open, or its values are no Hounsfield values: open its CT, or set tissue: layers</source>
            <translation type="unfinished">l’exercice {exercise_id} a tissue: field, mais son CT n’est pas ouvert, ou ses valeurs ne sont pas des valeurs Hounsfield : ouvrez son CT, ou mettez tissue: layers</translation>
        </message>
        <message>
            <source>layers: there is no CT in Hounsfield values</source>
            <translation type="unfinished">couches : il n’y a pas de CT en valeurs Hounsfield</translation>
        </message>
        <message>
            <source>this record cannot be replayed: it has no {tissue_file}</source>
            <translation type="unfinished">cet enregistrement ne peut pas être relu : il n’a pas de {tissue_file}</translation>
        </message>
        <message>
            <source>this record cannot be replayed: {tissue_file} is {field_digest}, and it was made with {recorded_digest}</source>
            <translation type="unfinished">cet enregistrement ne peut pas être relu : {tissue_file} est {field_digest}, et il a été fait avec {recorded_digest}</translation>
        </message>
        <message>
            <source>nothing is called for: a tool in a trocar moves in an inflated belly</source>
            <translation type="unfinished">rien n’est requis : un instrument dans un trocart se déplace dans un abdomen insufflé</translation>
        </message>
        <message>
            <source>nothing is called for: there is no CT in Hounsfield units</source>
            <translation type="unfinished">rien n’est requis : il n’y a pas de CT en unités Hounsfield</translation>
        </message>
        <message>
            <source>the first start compiles what follows the marker</source>
            <translation type="unfinished">le premier démarrage compile ce qui suit le marqueur</translation>
        </message>
        <message>
            <source>{tissue}: the loop had it, the walk had not</source>
            <translation type="unfinished">{tissue} : dans la boucle de commande, pas dans le parcours</translation>
        </message>
        <message>
            <source>{tissue}: the walk had it, the loop had not</source>
            <translation type="unfinished">{tissue} : dans le parcours, pas dans la boucle de commande</translation>
        </message>
        <message>
            <source>{declared_path} has no function preview(): it has no page</source>
            <translation type="unfinished">{declared_path} n’a pas de fonction preview() : il n’a pas de page</translation>
        </message>
        <message>
            <source>a simulated pen has no tip to measure; give --source usb:0</source>
            <translation type="unfinished">un stylo simulé n’a pas de pointe à mesurer ; donnez --source usb:0</translation>
        </message>
        <message>
            <source>machines</source>
            <translation type="unfinished">machines</translation>
        </message>
        <message>
            <source>{path} must define FEATURE, a class of Feature; see 'How to add a panel'</source>
            <translation type="unfinished">{path} doit définir FEATURE, une classe de Feature ; voir « How to add a panel »</translation>
        </message>
        <message>
            <source>{path}: after is {declared_get!r}; valid are {names}</source>
            <translation type="unfinished">{path} : after vaut {declared_get!r} ; sont valides {names}</translation>
        </message>
        <message>
            <source>loading the routines</source>
            <translation type="unfinished">chargement des routines</translation>
        </message>
        <message>
            <source>greeting the board</source>
            <translation type="unfinished">prise de contact avec la carte</translation>
        </message>
        <message>
            <source>waiting for joint angles</source>
            <translation type="unfinished">attente des angles des articulations</translation>
        </message>
        <message>
            <source>the robot at {port} was greeted but sends no joint angles; see `acus device test {port}`</source>
            <translation type="unfinished">le robot sur {port} a répondu mais n’envoie pas d’angles articulaires ; voir `acus device test {port}`</translation>
        </message>
        <message>
            <source>exercise {exercise_id} has tissue: {exercise_tissue}, and its field has not been made: make it first, or set tissue: layers</source>
            <translation type="unfinished">l’exercice {exercise_id} a tissue: {exercise_tissue}, et son champ n’a pas été créé : créez-le d’abord, ou mettez tissue: layers</translation>
        </message>
        <message>
            <source>this needs the two cameras of a robot; {noun} has none</source>
            <translation type="unfinished">ceci demande les deux caméras d’un robot ; {noun} n’en a pas</translation>
        </message>
        <message>
            <source>{noun} has no robot that could push: no effect is computed</source>
            <translation type="unfinished">{noun} n’a pas de robot qui puisse pousser : aucun effet n’est calculé</translation>
        </message>
        <message>
            <source>effect {effect} is not simulated in {exercise_id}: nobody needs what it gives; `acus explain {exercise_id}` says why</source>
            <translation type="unfinished">l’effet {effect} n’est pas simulé dans {exercise_id} : personne n’a besoin de ce qu’il donne ; `acus explain {exercise_id}` dit pourquoi</translation>
        </message>
        <message>
            <source>this record cannot be replayed: it has no {name}</source>
            <translation type="unfinished">cet enregistrement ne peut pas être relu : il n’a pas de {name}</translation>
        </message>
        <message>
            <source>this record cannot be replayed: {name} is damaged: {error}</source>
            <translation type="unfinished">cet enregistrement ne peut pas être relu : {name} est endommagé : {error}</translation>
        </message>
        <message>
            <source>this record cannot be replayed: its seed is {seed!r}</source>
            <translation type="unfinished">cet enregistrement ne peut pas être relu : sa graine est {seed!r}</translation>
        </message>
        <message>
            <source>{name} has shape {array_shape}; {shape} is needed</source>
            <translation type="unfinished">{name} est de forme {array_shape} ; il faut {shape}</translation>
        </message>
        <message>
            <source>{name} {array} has no direction</source>
            <translation type="unfinished">{name} {array} n’a pas de direction</translation>
        </message>
        <message>
            <source>a number is needed</source>
            <translation type="unfinished">il faut un nombre</translation>
        </message>
        <message>
            <source>cannot read {path}: {error_strerror}</source>
            <translation type="unfinished">impossible de lire {path} : {error_strerror}</translation>
        </message>
        <message>
            <source>{path} is not valid YAML: {line}</source>
            <translation type="unfinished">{path} n’est pas du YAML valide : {line}</translation>
        </message>
        <message>
            <source>{origin} is not valid YAML: it is nested too deeply</source>
            <translation type="unfinished">{origin} n’est pas du YAML valide : il est trop imbriqué</translation>
        </message>
        <message>
            <source>{origin} is not valid YAML: {line}</source>
            <translation type="unfinished">{origin} n’est pas du YAML valide : {line}</translation>
        </message>
        <message>
            <source>{origin}: {faults}</source>
            <translation type="unfinished">{origin} : {faults}</translation>
        </message>
        <message>
            <source>{package} is not installed; install the extra `{extra}`: {install_command}</source>
            <translation type="unfinished">{package} n’est pas installé ; installez l’extra `{extra}` : {install_command}</translation>
        </message>
        <message>
            <source>its packages stand in pyproject.toml</source>
            <translation type="unfinished">ses paquets figurent dans pyproject.toml</translation>
        </message>
        <message>
            <source>waiting {waited:.0f} s for the program to load (the first start after an installation compiles, for a minute or two)</source>
            <translation type="unfinished">attente du chargement du programme depuis {waited:.0f} s (le premier démarrage après une installation compile, une minute ou deux)</translation>
        </message>
        <message>
            <source>loading</source>
            <translation type="unfinished">chargement</translation>
        </message>
        <message>
            <source>{group} has no field {unknown}; it has {places_fields}</source>
            <translation type="unfinished">{group} n’a pas de champ {unknown} ; il a {places_fields}</translation>
        </message>
        <message>
            <source>{group} needs {missing} as well</source>
            <translation type="unfinished">{group} demande aussi {missing}</translation>
        </message>
        <message>
            <source>{folder} cannot be read: {reason}</source>
            <translation type="unfinished">impossible de lire {folder} : {reason}</translation>
        </message>
        <message>
            <source>: {folder} has that name</source>
            <translation type="unfinished">: {folder} porte ce nom</translation>
        </message>
        <message>
            <source>{folder}: there is no such folder</source>
            <translation type="unfinished">{folder} : ce dossier n’existe pas</translation>
        </message>
        <message>
            <source>{name!r} is no package that can be imported{taken}: a folder of plug-ins has an __init__.py and a name of its own that is a Python name</source>
            <translation type="unfinished">{name!r} n’est pas un paquet importable{taken} : un dossier de modules d’extension a un __init__.py et un nom à lui qui est un nom Python</translation>
        </message>
        <message>
            <source>{name} is {setting:g} {parameters_unit}; published are {known_least:g} to {known_most:g} ({known_source})</source>
            <translation type="unfinished">{name} vaut {setting:g} {parameters_unit} ; les valeurs publiées vont de {known_least:g} à {known_most:g} ({known_source})</translation>
        </message>
        <message>
            <source>there is no {kind} {name!r}; there are {known}</source>
            <translation type="unfinished">{kind} {name!r} n’existe pas ; il y a {known}</translation>
        </message>
        <message>
            <source>two files are the {noun} {name!r}: {first} and {second}; rename one</source>
            <translation type="unfinished">deux fichiers sont {noun} {name!r} : {first} et {second} ; renommez-en un</translation>
        </message>
        <message>
            <source>{kind} file {path} cannot be read: {reason}</source>
            <translation type="unfinished">{kind} : le fichier {path} ne peut pas être lu : {reason}</translation>
        </message>
        <message>
            <source>{path}: {name!r} is a name of the program's own; rename the file</source>
            <translation type="unfinished">{path} : {name!r} est un nom propre au programme ; renommez le fichier</translation>
        </message>
        <message>
            <source>{kind} file {path} cannot be imported: {fault}</source>
            <translation type="unfinished">{kind} : le fichier {path} ne peut pas être importé : {fault}</translation>
        </message>
        <message>
            <source>{path}: {doing}: {fault}</source>
            <translation type="unfinished">{path} : {doing} : {fault}</translation>
        </message>
        <message>
            <source>{kind} file {declared_path} cannot be imported: {fault}</source>
            <translation type="unfinished">{kind} : le fichier {declared_path} ne peut pas être importé : {fault}</translation>
        </message>
        <message>
            <source>it is no Python file</source>
            <translation type="unfinished">ce n’est pas un fichier Python</translation>
        </message>
        <message>
            <source>{path} has no {name} = {{...}}; see 'How to add {kind_noun}'</source>
            <translation type="unfinished">{path} n’a pas de {name} = {{...}} ; voir « How to add {kind_noun} »</translation>
        </message>
        <message>
            <source>{path}, line {line}: {name} must have exactly the keys {kind_fields}{may}; check {differing}</source>
            <translation type="unfinished">{path}, ligne {line} : {name} doit avoir exactement les clés {kind_fields}{may} ; vérifiez {differing}</translation>
        </message>
        <message>
            <source>{path} has no function {function}(); see 'How to add {kind_noun}'</source>
            <translation type="unfinished">{path} n’a pas de fonction {function}() ; voir « How to add {kind_noun} »</translation>
        </message>
        <message>
            <source>{path}, line {line}: published names {unknown_name!r}, which is no parameter; it has {parameters}</source>
            <translation type="unfinished">{path}, ligne {line} : « published » nomme {unknown_name!r}, qui n’est pas un paramètre ; existants : {parameters}</translation>
        </message>
        <message>
            <source>{path}, line {node_lineno}: {name} is not a literal: {reason}</source>
            <translation type="unfinished">{path}, ligne {node_lineno} : {name} n’est pas un littéral : {reason}</translation>
        </message>
        <message>
            <source>{path}, line {line}: {fault}; give {wanted_valid}</source>
            <translation type="unfinished">{path}, ligne {line} : {fault} ; valeur valide : {wanted_valid}</translation>
        </message>
        <message>
            <source>{path}, line {line}: {key} is {setting!r}; give {wanted_valid}</source>
            <translation type="unfinished">{path}, ligne {line} : {key} vaut {setting!r} ; valeur valide : {wanted_valid}</translation>
        </message>
        <message>
            <source>{name!r} is not a slot of core.state_vector{hint}</source>
            <translation type="unfinished">{name!r} n’est pas un emplacement de core.state_vector{hint}</translation>
        </message>
        <message>
            <source>{strange} is the loop's own</source>
            <translation type="unfinished">{strange} est réservé à la boucle de commande elle-même</translation>
        </message>
        <message>
            <source>parameter {name!r}</source>
            <translation type="unfinished">paramètre {name!r}</translation>
        </message>
        <message>
            <source>parameter {name!r} is {row!r}</source>
            <translation type="unfinished">le paramètre {name!r} vaut {row!r}</translation>
        </message>
        <message>
            <source>published {name!r}</source>
            <translation type="unfinished">published {name!r}</translation>
        </message>
        <message>
            <source>published {name!r} is {row!r}</source>
            <translation type="unfinished">published {name!r} vaut {row!r}</translation>
        </message>
        <message>
            <source>published {name!r} is {least:g} to {most:g}, and {measured:g} was measured, which lies outside</source>
            <translation type="unfinished">published {name!r} va de {least:g} à {most:g} ; on a mesuré {measured:g}, hors de cet intervalle</translation>
        </message>
        <message>
            <source>{owner} has no parameter {unknown_name!r}; it has {declared_parameters}</source>
            <translation type="unfinished">{owner} n’a pas de paramètre {unknown_name!r} ; existants : {declared_parameters}</translation>
        </message>
        <message>
            <source>{declared_path}: {name} takes {limit_default!r} from the device profile, which has no such field</source>
            <translation type="unfinished">{declared_path} : {name} prend {limit_default!r} dans le profil de l’appareil, qui n’a pas ce champ</translation>
        </message>
        <message>
            <source>{owner} needs {name} [{limit_unit}]: {limit_meaning}</source>
            <translation type="unfinished">{owner} a besoin de {name} [{limit_unit}] : {limit_meaning}</translation>
        </message>
        <message>
            <source>{owner}: {name} is {setting!r}; give {limit_minimum:g} to {limit_maximum:g} {limit_unit}</source>
            <translation type="unfinished">{owner} : {name} vaut {setting!r} ; donnez {limit_minimum:g} à {limit_maximum:g} {limit_unit}</translation>
        </message>
        <message>
            <source>state_vector: the input at place {slot} stands below a slot that is none; move its line up among the inputs</source>
            <translation type="unfinished">state_vector : l’entrée à l’emplacement {slot} se trouve sous un emplacement qui n’en est pas une ; remontez sa ligne parmi les entrées</translation>
        </message>
        <message>
            <source>state_vector: INPUTS does not stand directly below the last input</source>
            <translation type="unfinished">state_vector : INPUTS n’est pas directement sous la dernière entrée</translation>
        </message>
        <message>
            <source>state_vector: the parts of a vector lie at the places {slots}; put their lines one below the other, in the order x, y, z or left, right</source>
            <translation type="unfinished">state_vector : les composantes d’un vecteur sont aux emplacements {slots} ; placez leurs lignes les unes sous les autres, dans l’ordre x, y, z ou left, right</translation>
        </message>
        <message>
            <source>rotation {rotation} is not orthonormal</source>
            <translation type="unfinished">la rotation {rotation} n’est pas orthonormée</translation>
        </message>
        <message>
            <source>rotation {rotation} is a reflection</source>
            <translation type="unfinished">la rotation {rotation} est une réflexion</translation>
        </message>
        <message>
            <source>last row of a rigid transform is {array}</source>
            <translation type="unfinished">la dernière ligne d’une transformation rigide est {array}</translation>
        </message>
        <message>
            <source>the bench is closed; open it first</source>
            <translation type="unfinished">le banc est fermé ; ouvrez-le d’abord</translation>
        </message>
        <message>
            <source>the bench was not opened; open it first</source>
            <translation type="unfinished">le banc n’a pas été ouvert ; ouvrez-le d’abord</translation>
        </message>
        <message>
            <source>{step} needs the device to be homed since it was switched on; run `--step homing` first</source>
            <translation type="unfinished">{step} demande que la prise d’origine ait été faite depuis la mise sous tension ; lancez d’abord `--step homing`</translation>
        </message>
        <message>
            <source>{step} pushes, so the signs must be checked since the device was switched on; run `--step signs` first</source>
            <translation type="unfinished">{step} exerce une force : les signes doivent avoir été vérifiés depuis la mise sous tension ; lancez d’abord `--step signs`</translation>
        </message>
        <message>
            <source>{title}: {reason}</source>
            <translation type="unfinished">{title} : {reason}</translation>
        </message>
        <message>
            <source>{title}: the force would point along the needle, where the robot cannot push; hold the needle upright</source>
            <translation type="unfinished">{title} : la force agirait le long de l’aiguille, où le robot ne peut pas pousser ; tenez l’aiguille à la verticale</translation>
        </message>
        <message>
            <source>Force scale: {readings} readings for {forces} forces; give one reading in grams for each</source>
            <translation type="unfinished">Échelle de force : lectures : {readings}, forces : {forces} ; donnez une lecture en grammes pour chaque force</translation>
        </message>
        <message>
            <source>Force scale: the readings {grams} g are not all numbers; weigh again</source>
            <translation type="unfinished">Échelle de force : les lectures {grams} g ne sont pas toutes des nombres ; pesez à nouveau</translation>
        </message>
        <message>
            <source>measured over commanded force is {factor:.3f}</source>
            <translation type="unfinished">la force mesurée divisée par la force commandée vaut {factor:.3f}</translation>
        </message>
        <message>
            <source>the readings scatter by {residual:.3f} N about a line (at most {largest_residual:g} N): tare the scale, keep the needle still, and weigh again</source>
            <translation type="unfinished">les lectures s’écartent de {residual:.3f} N d’une droite (au plus {largest_residual:g} N) : tarez la balance, tenez l’aiguille immobile et pesez à nouveau</translation>
        </message>
        <message>
            <source>the scale does not feel the robot; check thread, tare and motor supply</source>
            <translation type="unfinished">la balance ne sent pas le robot ; vérifiez le fil, la tare et l’alimentation des moteurs</translation>
        </message>
        <message>
            <source>the sign is wrong; check the direction of the set-up, then the signs</source>
            <translation type="unfinished">le signe est faux ; vérifiez le sens du montage, puis les signes</translation>
        </message>
        <message>
            <source>the gear ratio {gear:g}:1 seems to be missing in the torque factor: the board takes the joint torque for the motor shaft's; divide its torque factor by the gear ratio</source>
            <translation type="unfinished">le rapport de réduction {gear:g}:1 semble manquer dans le facteur de couple : la carte prend le couple de l’articulation pour celui de l’arbre moteur ; divisez son facteur de couple par le rapport de réduction</translation>
        </message>
        <message>
            <source>the gear ratio {gear:g}:1 seems to be applied twice; multiply the board's torque factor by the gear ratio</source>
            <translation type="unfinished">le rapport de réduction {gear:g}:1 semble appliqué deux fois ; multipliez le facteur de couple de la carte par le rapport de réduction</translation>
        </message>
        <message>
            <source>check torque constant, amplifier gain and lengths in the profile against the device</source>
            <translation type="unfinished">comparez la constante de couple, le gain de l’amplificateur et les longueurs du profil avec l’appareil</translation>
        </message>
        <message>
            <source>{title}: the board measures no force; connect the gauge's amplifier, or leave this step out: forces are then shown as estimated</source>
            <translation type="unfinished">{title} : la carte ne mesure aucune force ; branchez l’amplificateur du capteur de force, ou sautez cette étape : les forces sont alors affichées comme estimées</translation>
        </message>
        <message>
            <source>Gauge calibration: give one reading for each of at least two different weights</source>
            <translation type="unfinished">Étalonnage du capteur de force : donnez une lecture pour chacun d’au moins deux poids différents</translation>
        </message>
        <message>
            <source>Gauge calibration: a reading is not a number; read again</source>
            <translation type="unfinished">Étalonnage du capteur de force : une lecture n’est pas un nombre ; relisez</translation>
        </message>
        <message>
            <source>Gauge calibration: the reading changes by {slope:.3f} N per newton (valid {least_scale:g} to {largest_scale:g}): check the amplifier's gain and polarity, and which way the weights pull</source>
            <translation type="unfinished">Étalonnage du capteur de force : la lecture change de {slope:.3f} N par newton (valide : {least_scale:g} à {largest_scale:g}) : vérifiez le gain et la polarité de l’amplificateur, et dans quel sens tirent les poids</translation>
        </message>
        <message>
            <source>Gauge calibration: the readings lie {residual:.2f} N off a line (at most {gauge_residual:g} N): let the weights hang still and free</source>
            <translation type="unfinished">Étalonnage du capteur de force : les lectures sont à {residual:.2f} N d’une droite (au plus {gauge_residual:g} N) : laissez les poids pendre librement, sans bouger</translation>
        </message>
        <message>
            <source>{title}: the {side} joint does not move up to {largest:g} N·m; let go of the needle, or look for what rubs</source>
            <translation type="unfinished">{title} : l’articulation ({side}) ne bouge pas jusqu’à {largest:g} N·m ; lâchez l’aiguille, ou cherchez ce qui frotte</translation>
        </message>
        <message>
            <source>{title}: the {side} joint does not keep {speed:g} rad/s with {largest:g} N·m; take the needle out, or look for what rubs</source>
            <translation type="unfinished">{title} : l’articulation ({side}) ne maintient pas {speed:g} rad/s avec {largest:g} N·m ; enlevez l’aiguille, ou cherchez ce qui frotte</translation>
        </message>
        <message>
            <source>too few readings while the joint moved; is the link slow?</source>
            <translation type="unfinished">trop peu de lectures pendant le mouvement de l’articulation ; la liaison est-elle lente ?</translation>
        </message>
        <message>
            <source>Friction: the joint moved at once, without a ramp; is the torque factor far too large?</source>
            <translation type="unfinished">Frottement : l’articulation a bougé tout de suite, sans rampe ; le facteur de couple est-il bien trop grand ?</translation>
        </message>
        <message>
            <source>move both links outwards against their stops (left {left:.1f}°, right {right:.1f}°), hold them there and confirm</source>
            <translation type="unfinished">écartez les deux segments jusqu’à leurs butées (gauche {left:.1f}°, droite {right:.1f}°), maintenez-les là et confirmez</translation>
        </message>
        <message>
            <source>{title}: with the needle upright the angles give a tilt of {tilt:.0f}° (at most {upright_deg:g}° by eye); an encoder counts the wrong way or not at all, the reference pose was not reached, or counts_per_turn ({encoder_counts_per_turn}) is wrong</source>
            <translation type="unfinished">{title} : aiguille verticale, les angles donnent une inclinaison de {tilt:.0f}° (au plus {upright_deg:g}° à l’œil) ; un codeur compte à l’envers ou pas du tout, la pose de référence n’a pas été atteinte, ou counts_per_turn ({encoder_counts_per_turn}) est faux</translation>
        </message>
        <message>
            <source>{title}: {pose} (left {left:.1f}°, right {right:.1f}°) is none that the links can take: {error}; check home_offsets and the link lengths</source>
            <translation type="unfinished">{title} : {pose} (gauche {left:.1f}°, droite {right:.1f}°) est une pose que les segments ne peuvent pas prendre : {error} ; vérifiez home_offsets et les longueurs des segments</translation>
        </message>
        <message>
            <source>put the needle into the jig that holds it vertical and confirm</source>
            <translation type="unfinished">placez l’aiguille dans le gabarit qui la tient verticale et confirmez</translation>
        </message>
        <message>
            <source>{title}: the angles give a tilt of {tilt:.0f}°, the ball joint allows {limit:g}°; an encoder counts the wrong way, or the jig is not vertical</source>
            <translation type="unfinished">{title} : les angles donnent une inclinaison de {tilt:.0f}°, la rotule permet {limit:g}° ; un codeur compte à l’envers, ou le gabarit n’est pas vertical</translation>
        </message>
        <message>
            <source>{title}: </source>
            <translation type="unfinished">{title} : </translation>
        </message>
        <message>
            <source>{title}: {problem}</source>
            <translation type="unfinished">{title} : {problem}</translation>
        </message>
        <message>
            <source>no encoder saw the {side} link move (at least {turn_deg:.0f}° were asked for): check the encoder's cable and supply</source>
            <translation type="unfinished">aucun codeur n’a vu bouger le segment ({side}) (il fallait au moins {turn_deg:.0f}°) : vérifiez le câble et l’alimentation du codeur</translation>
        </message>
        <message>
            <source>the other encoder moved more when the {side} link was turned: the encoders of left and right are swapped (exchange their plugs), or the wrong link was turned</source>
            <translation type="unfinished">quand le segment ({side}) a été tourné, l’autre codeur a bougé davantage : les codeurs gauche et droit sont inversés (échangez leurs connecteurs), ou le mauvais segment a été tourné</translation>
        </message>
        <message>
            <source>the {side} encoder counts backwards: exchange its channels A and B, or reverse it in the board's settings</source>
            <translation type="unfinished">le codeur ({side}) compte à l’envers : échangez ses voies A et B, ou inversez-le dans les réglages de la carte</translation>
        </message>
        <message>
            <source>no motor moves anything: check the switch of the motor supply, the amplifiers' enable and the motor cables, and that nothing blocks the needle</source>
            <translation type="unfinished">aucun moteur ne fait rien bouger : vérifiez l’interrupteur de l’alimentation des moteurs, l’activation des amplificateurs et les câbles des moteurs, et que rien ne bloque l’aiguille</translation>
        </message>
        <message>
            <source>the {motor} motor moves nothing up to 0.03 N·m: its joint is blocked, or its amplifier has no power or no enable</source>
            <translation type="unfinished">le moteur ({motor}) ne fait rien bouger jusqu’à 0,03 N·m : son articulation est bloquée, ou son amplificateur n’est pas alimenté ou pas activé</translation>
        </message>
        <message>
            <source>the motors are swapped: exchange the motor cables of left and right</source>
            <translation type="unfinished">les moteurs sont inversés : échangez les câbles des moteurs gauche et droit</translation>
        </message>
        <message>
            <source>both motors move the same encoder: the {other} encoder does not count, its joint is blocked, or both motors are wired to one amplifier</source>
            <translation type="unfinished">les deux moteurs font bouger le même codeur : le codeur ({other}) ne compte pas, son articulation est bloquée, ou les deux moteurs sont branchés au même amplificateur</translation>
        </message>
        <message>
            <source>the {side} motor turns backwards: exchange its two leads, or reverse it in the board's settings</source>
            <translation type="unfinished">le moteur ({side}) tourne à l’envers : échangez ses deux fils, ou inversez-le dans les réglages de la carte</translation>
        </message>
        <message>
            <source>{title}: the left joint does not follow a step of {torque:g} N·m; run the sign check, and take the needle out</source>
            <translation type="unfinished">{title} : l’articulation gauche ne suit pas un échelon de {torque:g} N·m ; lancez la vérification des signes, et enlevez l’aiguille</translation>
        </message>
        <message>
            <source>Latency: too few readings between rest and motion; is the link slow or the step lost?</source>
            <translation type="unfinished">Latence : trop peu de lectures entre le repos et le mouvement ; la liaison est-elle lente, ou l’échelon s’est-il perdu ?</translation>
        </message>
        <message>
            <source>Latency: the joint does not speed up under a constant torque</source>
            <translation type="unfinished">Latence : l’articulation n’accélère pas sous un couple constant</translation>
        </message>
        <message>
            <source>device {device} has no calibration that could be undone</source>
            <translation type="unfinished">l’appareil {device} n’a pas d’étalonnage à annuler</translation>
        </message>
        <message>
            <source>the board calls itself {key!r}; a serial number is up to 64 letters, digits, '.', '-' and '_': set another one in its firmware</source>
            <translation type="unfinished">la carte se nomme {key!r} ; un numéro de série a jusqu’à 64 lettres, chiffres, « . », « - » et « _ » : mettez-en un autre dans son micrologiciel</translation>
        </message>
        <message>
            <source>the calibration record is damaged: {error}; mend it, or move it away and calibrate anew (nothing was changed)</source>
            <translation type="unfinished">le fichier d’étalonnage est endommagé : {error} ; réparez-le, ou déplacez-le et refaites l’étalonnage (rien n’a été modifié)</translation>
        </message>
        <message>
            <source>{path} belongs to device {record_device!r}, not {key!r}; it was copied or renamed</source>
            <translation type="unfinished">{path} appartient à l’appareil {record_device!r}, pas à {key!r} ; le fichier a été copié ou renommé</translation>
        </message>
        <message>
            <source>cannot write {path}: {error_strerror}; set ACUS_DATA to a folder that can be written</source>
            <translation type="unfinished">impossible d’écrire {path} : {error_strerror} ; réglez ACUS_DATA sur un dossier où l’on peut écrire</translation>
        </message>
        <message>
            <source>{report_failure} ({checks} counts no more: do this step again)</source>
            <translation type="unfinished">{report_failure} ({checks} ne compte plus : refaites cette étape)</translation>
        </message>
        <message>
            <source>encoder offsets left {left:+.5f} rad, right {right:+.5f} rad (by {reference})</source>
            <translation type="unfinished">zéros des codeurs : gauche {left:+.5f} rad, droite {right:+.5f} rad (référence : {reference})</translation>
        </message>
        <message>
            <source>by hand and by pulses</source>
            <translation type="unfinished">à la main et par impulsions</translation>
        </message>
        <message>
            <source>by pulses only</source>
            <translation type="unfinished">par impulsions seulement</translation>
        </message>
        <message>
            <source>motors and encoders agree, checked {how}</source>
            <translation type="unfinished">moteurs et codeurs concordent, vérifiés {how}</translation>
        </message>
        <message>
            <source>round trip {median:.2f} ms (99 %: {high:.2f}, largest {largest:.2f}), lost {lost:.2f} %, torque to motion {dead_time:.1f} ± {dead_time_spread:.1f} ms</source>
            <translation type="unfinished">aller-retour {median:.2f} ms (99 % : {high:.2f}, maximum {largest:.2f}), perdus {lost:.2f} %, du couple au mouvement {dead_time:.1f} ± {dead_time_spread:.1f} ms</translation>
        </message>
        <message>
            <source>force scale {factor:.3f}, residual {residual:.3f} N: {verdict}</source>
            <translation type="unfinished">échelle de force {factor:.3f}, résidu {residual:.3f} N : {verdict}</translation>
        </message>
        <message>
            <source>gauge zero {zero:+.3f} N, scale {scale:.4f}, ± {residual:.3f} N</source>
            <translation type="unfinished">capteur de force : zéro {zero:+.3f} N, échelle {scale:.4f}, ± {residual:.3f} N</translation>
        </message>
        <message>
            <source>{title}: nothing is asked; there is nothing to answer</source>
            <translation type="unfinished">{title} : rien n’est demandé ; il n’y a rien à répondre</translation>
        </message>
        <message>
            <source>{title}: {reading} is not a number; type the reading in {report_unit}</source>
            <translation type="unfinished">{title} : {reading} n’est pas un nombre ; saisissez la lecture en {report_unit}</translation>
        </message>
        <message>
            <source>{title}: the joints do not stand still, or are not read; hold the needle still, or check the encoder cables</source>
            <translation type="unfinished">{title} : les articulations ne sont pas immobiles, ou ne sont pas lues ; tenez l’aiguille immobile, ou vérifiez les câbles des codeurs</translation>
        </message>
        <message>
            <source>{title}: {state_fault_message}</source>
            <translation type="unfinished">{title} : {state_fault_message}</translation>
        </message>
        <message>
            <source>the loop does not tick; start it before the routine</source>
            <translation type="unfinished">la boucle de commande ne tourne pas ; démarrez-la avant la procédure</translation>
        </message>
        <message>
            <source>the loop does not answer in time to arm the forces; close other programs, try again</source>
            <translation type="unfinished">la boucle de commande ne répond pas à temps pour armer les forces ; fermez d’autres programmes et réessayez</translation>
        </message>
        <message>
            <source>the forces cannot be armed: {state_fault_message}</source>
            <translation type="unfinished">impossible d’armer les forces : {state_fault_message}</translation>
        </message>
        <message>
            <source>the loop has not answered within {patience:g} s: it does not tick</source>
            <translation type="unfinished">la boucle de commande n’a pas répondu depuis {patience:g} s : elle ne tourne pas</translation>
        </message>
        <message>
            <source>the checkpoint's state has {state_size} slots, this program's {sv_slots}</source>
            <translation type="unfinished">l’état du point de reprise a {state_size} emplacements, celui de ce programme {sv_slots}</translation>
        </message>
        <message>
            <source>this program's state has no slot {name!r}, which the record gives</source>
            <translation type="unfinished">l’état de ce programme n’a pas d’emplacement {name!r}, que donne l’enregistrement</translation>
        </message>
        <message>
            <source>the record has no stage {stage_name!r} in this place; its stages are {checkpoint_names}</source>
            <translation type="unfinished">l’enregistrement n’a pas d’étape {stage_name!r} à cet endroit ; ses étapes sont {checkpoint_names}</translation>
        </message>
        <message>
            <source>stage {stage_name!r} has {recorded_numbers} numbers in the record and {expected_numbers} in this program: another version recorded it</source>
            <translation type="unfinished">l’étape {stage_name!r} a {recorded_numbers} nombres dans l’enregistrement et {expected_numbers} dans ce programme : une autre version l’a enregistrée</translation>
        </message>
        <message>
            <source>{quantities} are {first} and {second}; both must be finite: calibrate anew</source>
            <translation type="unfinished">{quantities} : {first} et {second} ; les deux doivent être finis : refaites l’étalonnage</translation>
        </message>
        <message>
            <source>law {name!r}: {profile_name} cannot hold a direction by itself, its motors push; take the law 'fixture'</source>
            <translation type="unfinished">loi de force {name!r} : {profile_name} ne peut pas tenir seul une direction, ses moteurs poussent ; prenez la loi « fixture »</translation>
        </message>
        <message>
            <source>, or a device that can, such as {able}</source>
            <translation type="unfinished">, ou un appareil qui le peut, par exemple {able}</translation>
        </message>
        <message>
            <source>{law_path}: parameters() gives an array of the shape {array_shape} for these values; give one of the shape (n,), and of {shortest} numbers at least, as it was tried</source>
            <translation type="unfinished">{law_path} : parameters() donne pour ces valeurs un tableau de forme {array_shape} ; donnez-en un de forme (n,), d’au moins {shortest} nombres, tel qu’il a été essayé</translation>
        </message>
        <message>
            <source>{law_path}: energy_bound is {bound} J; give a finite number of 0 or more</source>
            <translation type="unfinished">{law_path} : energy_bound vaut {bound} J ; donnez un nombre fini supérieur ou égal à 0</translation>
        </message>
        <message>
            <source>{law_path}: step is not compiled; put @stage of core.compiled before it</source>
            <translation type="unfinished">{law_path} : step n’est pas compilé ; mettez devant lui @stage de core.compiled</translation>
        </message>
        <message>
            <source>law 'forbidden_region': the region with its margin reaches {reach:.1f} mm from its axis, and the entry lies {distance:.1f} mm from it; move it or make it smaller</source>
            <translation type="unfinished">loi « forbidden_region » : la région avec sa marge s’étend à {reach:.1f} mm de son axe, et le point d’entrée est à {distance:.1f} mm de lui ; déplacez-la ou réduisez-la</translation>
        </message>
        <message>
            <source>law 'forbidden_region': the region's axis points at the entry, so that a needle along it has no nearest point; turn the axis across the path or give a sphere</source>
            <translation type="unfinished">loi « forbidden_region » : l’axe de la région vise le point d’entrée, si bien qu’une aiguille dans cet axe n’a pas de point le plus proche ; tournez l’axe en travers de la trajectoire ou donnez une sphère</translation>
        </message>
        <message>
            <source>the loop did not stop in {stop_timeout:g} s: a stage does not return</source>
            <translation type="unfinished">la boucle de commande ne s’est pas arrêtée en {stop_timeout:g} s : une étape ne rend pas la main</translation>
        </message>
        <message>
            <source>the loop is closed; call open() before checkpoint()</source>
            <translation type="unfinished">la boucle de commande est fermée ; appelez open() avant checkpoint()</translation>
        </message>
        <message>
            <source>step needs a loop on a VirtualClock; this one runs by itself</source>
            <translation type="unfinished">step demande une boucle de commande sur une VirtualClock ; celle-ci tourne d’elle-même</translation>
        </message>
        <message>
            <source>the loop is closed; call open() before step()</source>
            <translation type="unfinished">la boucle de commande est fermée ; appelez open() avant step()</translation>
        </message>
        <message>
            <source>the table can be swapped only while the loop is closed; close it first</source>
            <translation type="unfinished">la table ne se remplace que quand la boucle de commande est fermée ; fermez-la d’abord</translation>
        </message>
        <message>
            <source>the loop is closed; a table is exchanged while it runs, see swap()</source>
            <translation type="unfinished">la boucle de commande est fermée ; une table s’échange pendant qu’elle tourne, voir swap()</translation>
        </message>
        <message>
            <source>the loop does not tick: the way it computes stays as it was</source>
            <translation type="unfinished">la boucle de commande ne tourne pas : le calcul reste tel qu’il était</translation>
        </message>
        <message>
            <source>the loop has ended: {reason}</source>
            <translation type="unfinished">la boucle de commande s’est terminée : {reason}</translation>
        </message>
        <message>
            <source>the state has no slot {name!r}; valid names: {sv_index}</source>
            <translation type="unfinished">l’état n’a pas d’emplacement {name!r} ; noms valides : {sv_index}</translation>
        </message>
        <message>
            <source>the declared energy is {bound} J; give a finite number of 0 or more</source>
            <translation type="unfinished">l’énergie déclarée est {bound} J ; donnez un nombre fini supérieur ou égal à 0</translation>
        </message>
        <message>
            <source>the loop has no input {name!r}; valid names: {input_names}</source>
            <translation type="unfinished">la boucle de commande n’a pas d’entrée {name!r} ; noms valides : {input_names}</translation>
        </message>
        <message>
            <source>device {profile_name}: its largest tension is {most} N and its fastest reel {profile_fastest_reel} m/s; give finite numbers of 0 or more</source>
            <translation type="unfinished">appareil {profile_name} : sa plus grande tension est {most} N et son enroulement le plus rapide {profile_fastest_reel} m/s ; donnez des nombres finis supérieurs ou égaux à 0</translation>
        </message>
        <message>
            <source>law {law_name!r} needs the dynamics of the machine, and {device} states none</source>
            <translation type="unfinished">la loi de force {law_name!r} demande la dynamique de la machine, et {device} n’en donne pas</translation>
        </message>
        <message>
            <source>machine {profile_kind!r}: its stage is named {name!r}, and so is another of the loop; give it a name of its own</source>
            <translation type="unfinished">machine {profile_kind!r} : son étape s’appelle {name!r}, comme une autre de la boucle de commande ; donnez-lui un nom à elle</translation>
        </message>
        <message>
            <source>{named} raises {fault}; mend or remove it, and start again</source>
            <translation type="unfinished">{named} signale {fault} ; corrigez l’erreur ou retirez-en la cause, puis redémarrez</translation>
        </message>
        <message>
            <source>{named} does not return: there is no force any more; end the program, mend or remove it, and start again</source>
            <translation type="unfinished">{named} ne rend pas la main : il n’y a plus de force ; quittez le programme, corrigez l’erreur ou retirez-en la cause, puis redémarrez</translation>
        </message>
        <message>
            <source>the force law or effect {name!r}</source>
            <translation type="unfinished">la loi de force ou l’effet {name!r}</translation>
        </message>
        <message>
            <source>the stage {name!r} of the loop</source>
            <translation type="unfinished">l’étape {name!r} de la boucle de commande</translation>
        </message>
        <message>
            <source>the wire is good</source>
            <translation type="unfinished">la liaison est bonne</translation>
        </message>
        <message>
            <source>{lost} of {commands} commands were never answered</source>
            <translation type="unfinished">commandes restées sans réponse : {lost} sur {commands}</translation>
        </message>
        <message>
            <source>the board fell silent {last_answer:.2f} s after the beginning: {unanswered}; check its power, its cable and its program, then test again</source>
            <translation type="unfinished">la carte s’est tue {last_answer:.2f} s après le début : {unanswered} ; vérifiez son alimentation, son câble et son programme, puis refaites le test</translation>
        </message>
        <message>
            <source>{unanswered}, at most {most_lost} may be: check the cable and its plugs, and what else this computer has to do, then test again</source>
            <translation type="unfinished">{unanswered}, au plus {most_lost} sont permises : vérifiez le câble et ses connecteurs, et ce que cet ordinateur a d’autre à faire, puis refaites le test</translation>
        </message>
        <message>
            <source>only {count_nonzero} answers of the robot on {port} came within a tick of {rate_hz:g} ms; lower loop.rate_hz in the profile or use a faster port</source>
            <translation type="unfinished">réponses du robot sur {port} arrivées en moins d’un cycle de {rate_hz:g} ms : seulement {count_nonzero} ; baissez loop.rate_hz dans le profil ou prenez un port plus rapide</translation>
        </message>
        <message>
            <source>the robot on {port} was greeted, but answers no command; see its firmware</source>
            <translation type="unfinished">le robot sur {port} s’est annoncé, mais ne répond à aucune commande ; voyez son micrologiciel</translation>
        </message>
        <message>
            <source>the board speaks version {theirs} of the protocol, this program version {wanted} ({received_bytes} bytes): update the {older_side} (docs/protocol.md)</source>
            <translation type="unfinished">la carte parle la version {theirs} du protocole, ce programme la version {wanted} ({received_bytes} octets) : mettez à jour le côté le plus ancien, {older_side} (docs/protocol.md)</translation>
        </message>
        <message>
            <source>no fault {name!r}; valid names: {faults}</source>
            <translation type="unfinished">il n’y a pas de défaut {name!r} ; noms valides : {faults}</translation>
        </message>
        <message>
            <source>fault {name} is {setting:g}; it must be from 0 to {most:g}</source>
            <translation type="unfinished">le défaut {name} vaut {setting:g} ; il doit aller de 0 à {most:g}</translation>
        </message>
        <message>
            <source>payload of {given_bytes} bytes; a frame holds 1 to {largest_payload}</source>
            <translation type="unfinished">charge utile de {given_bytes} octets ; une trame en contient 1 à {largest_payload}</translation>
        </message>
        <message>
            <source>device profile {profile_name} speaks the protocol haply but has no section haply; add it (see resources/devices/haply-2diy.yaml)</source>
            <translation type="unfinished">le profil d’appareil {profile_name} parle le protocole haply mais n’a pas de section haply ; ajoutez-la (voir resources/devices/haply-2diy.yaml)</translation>
        </message>
        <message>
            <source>the board reports error {code}, which this program does not know; see its firmware</source>
            <translation type="unfinished">la carte signale l’erreur {code}, que ce programme ne connaît pas ; voyez son micrologiciel</translation>
        </message>
        <message>
            <source>the link has not been opened yet; call open() first</source>
            <translation type="unfinished">la liaison n’a pas encore été ouverte ; appelez d’abord open()</translation>
        </message>
        <message>
            <source>the pen's joint angles {angles} are not finite</source>
            <translation type="unfinished">les angles {angles} des articulations du stylo ne sont pas finis</translation>
        </message>
        <message>
            <source>serial ports cannot be used on this system: {error}</source>
            <translation type="unfinished">les ports série ne peuvent pas être utilisés sur ce système : {error}</translation>
        </message>
        <message>
            <source>there is no port {path}; serial ports here: {there}. Plug the robot in and look with `acus device list`</source>
            <translation type="unfinished">il n’y a pas de port {path} ; ports série présents : {there}. Branchez le robot et regardez avec `acus device list`</translation>
        </message>
        <message>
            <source>you may not open {path}: add yourself to the group that owns it with `sudo usermod -aG dialout $USER`, then log out and in again</source>
            <translation type="unfinished">vous n’avez pas le droit d’ouvrir {path} : ajoutez-vous au groupe qui le possède avec `sudo usermod -aG dialout $USER`, puis déconnectez-vous et reconnectez-vous</translation>
        </message>
        <message>
            <source>{path} is busy: another program is using this robot; close it (`fuser -v {path}` names it)</source>
            <translation type="unfinished">{path} est occupé : un autre programme utilise ce robot ; fermez-le (`fuser -v {path}` le nomme)</translation>
        </message>
        <message>
            <source>{path} cannot be set to {baud} baud; correct wire.baud in the device profile</source>
            <translation type="unfinished">{path} ne peut pas être réglé à {baud} bauds ; corrigez wire.baud dans le profil de l’appareil</translation>
        </message>
        <message>
            <source>{path} is not a serial port; see `acus device list`</source>
            <translation type="unfinished">{path} n’est pas un port série ; voir `acus device list`</translation>
        </message>
        <message>
            <source>{path} has gone; plug the robot in again</source>
            <translation type="unfinished">{path} a disparu ; rebranchez le robot</translation>
        </message>
        <message>
            <source>{path} cannot be used: {error}</source>
            <translation type="unfinished">{path} ne peut pas être utilisé : {error}</translation>
        </message>
        <message>
            <source>no board that speaks Acus' protocol</source>
            <translation type="unfinished">aucune carte parlant le protocole d’Acus</translation>
        </message>
        <message>
            <source>the board says that it belongs to a robot of the profile {info_profile!r}, the program was started for {wanted_name!r}; choose the profile {right_profile}</source>
            <translation type="unfinished">la carte dit appartenir à un robot du profil {info_profile!r}, le programme a été lancé pour {wanted_name!r} ; choisissez le profil {right_profile}</translation>
        </message>
        <message>
            <source>the board counts {counts} per turn, the profile {wanted_name} says {encoder_counts_per_turn}; correct the profile or the firmware</source>
            <translation type="unfinished">la carte compte {counts} par tour, le profil {wanted_name} dit {encoder_counts_per_turn} ; corrigez le profil ou le micrologiciel</translation>
        </message>
        <message>
            <source>the board's watchdog waits {watchdog:g} ms, the profile {wanted_name} allows {wanted_wire_watchdog_ms:g} ms; update the firmware</source>
            <translation type="unfinished">le chien de garde de la carte attend {watchdog:g} ms, le profil {wanted_name} permet {wanted_wire_watchdog_ms:g} ms ; mettez à jour le micrologiciel</translation>
        </message>
        <message>
            <source>no Haply board with number {board_number}</source>
            <translation type="unfinished">aucune carte Haply de numéro {board_number}</translation>
        </message>
        <message>
            <source>{whom} answers: {seen} bytes came, but they make no sense; check that this is the robot's port (acus device list), its profile, and the baud rate there (wire.baud)</source>
            <translation type="unfinished">{whom} ne répond : {seen} octets sont arrivés, mais ils n’ont pas de sens ; vérifiez que c’est le port du robot (acus device list), son profil, et la vitesse qui y figure (wire.baud)</translation>
        </message>
        <message>
            <source>{whom} answers; check its power and cable, that this is the robot's port (acus device list), its profile, and the baud rate there (wire.baud)</source>
            <translation type="unfinished">{whom} ne répond ; vérifiez l’alimentation et le câble, que c’est le port du robot (acus device list), son profil, et la vitesse qui y figure (wire.baud)</translation>
        </message>
        <message>
            <source>nobody was greeted on {port} yet; call open() first</source>
            <translation type="unfinished">personne ne s’est encore annoncé sur {port} ; appelez d’abord open()</translation>
        </message>
        <message>
            <source>another robot answers on {port} (serial number {info_serial!r} instead of {serial!r}); plug the first one in again, or close and open the link</source>
            <translation type="unfinished">un autre robot répond sur {port} (numéro de série {info_serial!r} au lieu de {serial!r}) ; rebranchez le premier, ou fermez et rouvrez la liaison</translation>
        </message>
        <message>
            <source>{port}: {error}</source>
            <translation type="unfinished">{port} : {error}</translation>
        </message>
        <message>
            <source>serial robots are driven from inside the compiled loop, which exists on Linux only; this is {sys_platform}: use the simulated robot here</source>
            <translation type="unfinished">les robots série sont pilotés depuis la boucle de commande compilée, qui n’existe que sous Linux ; ici, c’est {sys_platform} : utilisez le robot simulé</translation>
        </message>
        <message>
            <source>serial robots are driven on Linux only; this is {sys_platform}</source>
            <translation type="unfinished">les robots série ne sont pilotés que sous Linux ; ici, c’est {sys_platform}</translation>
        </message>
        <message>
            <source>no force: the encoders' directions were not seen; home against the stops (`--step homing`), or check the signs by hand (`--step signs` without --yes)</source>
            <translation type="unfinished">pas de force : les sens des codeurs n’ont pas été vus ; faites la prise d’origine contre les butées (`--step homing`), ou vérifiez les signes à la main (`--step signs` sans --yes)</translation>
        </message>
        <message>
            <source>forces are held to {cap:g} N: {lack}; weigh it with a kitchen scale (docs/hardware.md): `acus device calibrate PORT --step force`</source>
            <translation type="unfinished">les forces restent limitées à {cap:g} N : {lack} ; pesez avec une balance de cuisine (docs/hardware.md) : `acus device calibrate PORT --step force`</translation>
        </message>
        <message>
            <source>the force scale of this device was never measured</source>
            <translation type="unfinished">l’échelle de force de cet appareil n’a jamais été mesurée</translation>
        </message>
        <message>
            <source>its force scale was measured with profile {profile}, not {profile_name}</source>
            <translation type="unfinished">son échelle de force a été mesurée avec le profil {profile}, pas {profile_name}</translation>
        </message>
        <message>
            <source>its force scale was {force_factor:.2f} on {force_date}, outside 1 ± {scale_tolerance:g}</source>
            <translation type="unfinished">son échelle de force était de {force_factor:.2f} le {force_date}, hors de 1 ± {scale_tolerance:g}</translation>
        </message>
        <message>
            <source>no force: the board does not number its power cycles, so it counts as not {lacks}; run `acus device calibrate PORT` after switching it on</source>
            <translation type="unfinished">pas de force : la carte ne numérote pas ses mises sous tension, donc ceci compte comme non fait : {lacks} ; lancez `acus device calibrate PORT` après la mise sous tension</translation>
        </message>
        <message>
            <source>no force: the robot was not {lacks} since it was switched on; do that step in the menu Robot, Commissioning, or with `acus device calibrate PORT --step {step}`</source>
            <translation type="unfinished">pas de force : pas fait depuis la mise sous tension du robot : {lacks} ; faites cette étape dans le menu Robot, Mise en service, ou avec `acus device calibrate PORT --step {step}`</translation>
        </message>
        <message>
            <source>the phantom needs no CT in the file: leave it out</source>
            <translation type="unfinished">le fantôme n’a pas besoin de CT dans le fichier : laissez-le de côté</translation>
        </message>
        <message>
            <source>packing {name}</source>
            <translation type="unfinished">compression de {name}</translation>
        </message>
        <message>
            <source>cannot write {path}: {error_strerror}</source>
            <translation type="unfinished">impossible d’écrire {path} : {error_strerror}</translation>
        </message>
        <message>
            <source>{folder} holds {count} series; one is needed</source>
            <translation type="unfinished">séries dans {folder} : {count} ; il en faut une seule</translation>
        </message>
        <message>
            <source>{subject} is another one than the exercise was made on: its digest is {digest}…, {wanted_digest}… is needed (acus ct digest tells it)</source>
            <translation type="unfinished">{subject} n’est pas celui sur lequel l’exercice a été fait : son empreinte est {digest}…, il faut {wanted_digest}… (acus ct digest la donne)</translation>
        </message>
        <message>
            <source>{path}: {exercise} is no text in UTF-8</source>
            <translation type="unfinished">{path} : {exercise} n’est pas un texte en UTF-8</translation>
        </message>
        <message>
            <source>cannot unpack {path}: {error_strerror}</source>
            <translation type="unfinished">impossible de décompresser {path} : {error_strerror}</translation>
        </message>
        <message>
            <source>{path} is no exercise file ({suffix}), or damaged: have it written again (acus exercise pack)</source>
            <translation type="unfinished">{path} n’est pas un fichier d’exercice ({suffix}), ou est endommagé : faites-le réécrire (acus exercise pack)</translation>
        </message>
        <message>
            <source>{path} holds {files} files; {most_files} are the most</source>
            <translation type="unfinished">fichiers dans {path} : {files} ; {most_files} au plus</translation>
        </message>
        <message>
            <source>{path} is not used: {member_filename!r} {reason}</source>
            <translation type="unfinished">{path} n’est pas utilisé : {member_filename!r} : {reason}</translation>
        </message>
        <message>
            <source>{path} is not used: {double_name!r} is in it twice</source>
            <translation type="unfinished">{path} n’est pas utilisé : {double_name!r} y figure deux fois</translation>
        </message>
        <message>
            <source>{path} is no exercise file: it has no {manifest}</source>
            <translation type="unfinished">{path} n’est pas un fichier d’exercice : il n’a pas de {manifest}</translation>
        </message>
        <message>
            <source>{path}: {manifest} is not JSON</source>
            <translation type="unfinished">{path} : {manifest} n’est pas du JSON</translation>
        </message>
        <message>
            <source>{path} was written by a newer Acus ({declared}): its form is {version}, this program reads up to {format}: install the newer one</source>
            <translation type="unfinished">{path} a été écrit par un Acus plus récent ({declared}) : son format est {version}, ce programme lit jusqu’à {format} : installez le plus récent</translation>
        </message>
        <message>
            <source>{path} is not used: its list of files is not what it holds</source>
            <translation type="unfinished">{path} n’est pas utilisé : sa liste de fichiers ne correspond pas à ce qu’il contient</translation>
        </message>
        <message>
            <source>{path} is not used: it would grow {growth:.0f} times to {unpacked_gb:.1f} GB</source>
            <translation type="unfinished">{path} n’est pas utilisé : il grossirait {growth:.0f} fois, jusqu’à {unpacked_gb:.1f} Go</translation>
        </message>
        <message>
            <source>{path} unpacks to {whole:.1f} GB and {free:.1f} GB are free in the temporary folder: make room</source>
            <translation type="unfinished">{path} fait {whole:.1f} Go une fois décompressé, et {free:.1f} Go sont libres dans le dossier temporaire : faites de la place</translation>
        </message>
        <message>
            <source>{path} is damaged at {name}: have it sent again</source>
            <translation type="unfinished">{path} est endommagé à {name} : faites-le renvoyer</translation>
        </message>
        <message>
            <source>unpacking {name}</source>
            <translation type="unfinished">décompression de {name}</translation>
        </message>
        <message>
            <source>{path}: {name} was altered after it was packed</source>
            <translation type="unfinished">{path} : {name} a été modifié après l’empaquetage</translation>
        </message>
        <message>
            <source>{path} is not used: exercise and {manifest} name different CTs</source>
            <translation type="unfinished">{path} n’est pas utilisé : l’exercice et {manifest} nomment des CT différents</translation>
        </message>
        <message>
            <source>{path} does not hold its CT: name the folder of the one with the digest {wanted}… (--ct DIR; acus ct digest tells it)</source>
            <translation type="unfinished">{path} ne contient pas son CT : nommez le dossier de celui d’empreinte {wanted}… (--ct DIR ; acus ct digest la donne)</translation>
        </message>
        <message>
            <source>none of the {series} CT series in {ct} is that of {path}: one with the digest {wanted}… is needed; name the folder that holds it</source>
            <translation type="unfinished">aucune des {series} séries CT de {ct} n’est celle de {path} : il en faut une d’empreinte {wanted}… ; nommez le dossier qui la contient</translation>
        </message>
        <message>
            <source>the library holds another CT under the name of this one, {taken_entry_name}: its digest is {again_digest}…, {wanted}… is needed; remove it first (acus library remove {taken_entry_name})</source>
            <translation type="unfinished">la bibliothèque contient un autre CT sous le nom {taken_entry_name} : son empreinte est {again_digest}…, il faut {wanted}… ; retirez-le d’abord (acus library remove {taken_entry_name})</translation>
        </message>
        <message>
            <source>the exercise cannot be used here: {field}: {reason}</source>
            <translation type="unfinished">l’exercice ne peut pas être utilisé ici : {field} : {reason}</translation>
        </message>
        <message>
            <source>the id {exercise_id!r} is taken by a file that cannot be used, or by earlier versions: keep this exercise under another name (--as NAME)</source>
            <translation type="unfinished">l’identifiant {exercise_id!r} est pris par un fichier inutilisable, ou par des versions antérieures : gardez cet exercice sous un autre nom (--as NAME)</translation>
        </message>
        <message>
            <source>there is another exercise {exercise_id!r}: keep this one under another name (--as NAME), or as a new version of it (--replace)</source>
            <translation type="unfinished">il y a déjà un autre exercice {exercise_id!r} : gardez celui-ci sous un autre nom (--as NAME), ou comme nouvelle version (--replace)</translation>
        </message>
        <message>
            <source>the exercise names {name!r}, which the file does not hold</source>
            <translation type="unfinished">l’exercice nomme {name!r}, que le fichier ne contient pas</translation>
        </message>
        <message>
            <source>there is no measurement to write: take one first</source>
            <translation type="unfinished">il n’y a pas de mesure à écrire : faites-en d’abord une</translation>
        </message>
        <message>
            <source>{path_name}: measurements are written as .csv or .mrk.json</source>
            <translation type="unfinished">{path_name} : les mesures s’écrivent en .csv ou en .mrk.json</translation>
        </message>
        <message>
            <source>{path} is not JSON: {error_split}</source>
            <translation type="unfinished">{path} n’est pas du JSON : {error_split}</translation>
        </message>
        <message>
            <source>{origin}: {error}</source>
            <translation type="unfinished">{origin} : {error}</translation>
        </message>
        <message>
            <source>{origin}: {name} is {short}; needed: {wanted}</source>
            <translation type="unfinished">{origin} : {name} vaut {short} ; il faut : {wanted}</translation>
        </message>
        <message>
            <source>cannot read {path}: {reason}</source>
            <translation type="unfinished">impossible de lire {path} : {reason}</translation>
        </message>
        <message>
            <source>{origin}: {reason}</source>
            <translation type="unfinished">{origin} : {reason}</translation>
        </message>
        <message>
            <source>{path}: panto_a1 {left} and panto_a5 {right} must lie on the x axis</source>
            <translation type="unfinished">{path} : panto_a1 {left} et panto_a5 {right} doivent être sur l’axe x</translation>
        </message>
        <message>
            <source>has a document type declaration (DOCTYPE), which a URDF never needs</source>
            <translation type="unfinished">contient une déclaration de type de document (DOCTYPE), dont un URDF n’a jamais besoin</translation>
        </message>
        <message>
            <source>{path}: joint {name!r} is there twice</source>
            <translation type="unfinished">{path} : l’articulation {name!r} figure deux fois</translation>
        </message>
        <message>
            <source>{path}: joint {name!r} is missing; there are: {there}</source>
            <translation type="unfinished">{path} : l’articulation {name!r} manque ; présentes : {there}</translation>
        </message>
        <message>
            <source>{place}: rpy is {turned!r}; turned joints are not supported</source>
            <translation type="unfinished">{place} : rpy vaut {turned!r} ; les articulations tournées ne sont pas prises en charge</translation>
        </message>
        <message>
            <source>{path}: joint {name!r} stands at ({x}, {y}, {z}) m; a link of the arms goes along +x</source>
            <translation type="unfinished">{path} : l’articulation {name!r} est en ({x}, {y}, {z}) m ; un segment des bras suit +x</translation>
        </message>
        <message>
            <source>{path}: the arms differ: {left} at {left_m} m, {right} at {right_m} m; Acus' pantograph is symmetric</source>
            <translation type="unfinished">{path} : les bras diffèrent : {left} à {left_m} m, {right} à {right_m} m ; le pantographe d’Acus est symétrique</translation>
        </message>
        <message>
            <source>{path}: link 'tool_phi_link' has no cylinder, which is the needle</source>
            <translation type="unfinished">{path} : le segment « tool_phi_link » n’a pas de cylindre, qui représente l’aiguille</translation>
        </message>
        <message>
            <source>{path}: link 'tool_phi_link' is missing; the needle is its cylinder</source>
            <translation type="unfinished">{path} : le segment « tool_phi_link » manque ; son cylindre représente l’aiguille</translation>
        </message>
        <message>
            <source>{place}: {coordinates!r} is not three numbers</source>
            <translation type="unfinished">{place} : {coordinates!r} n’est pas trois nombres</translation>
        </message>
        <message>
            <source>{place}: {expression!r} is a xacro expression; expand the file first (xacro FILE &gt; out.urdf)</source>
            <translation type="unfinished">{place} : {expression!r} est une expression xacro ; développez d’abord le fichier (xacro FILE &gt; out.urdf)</translation>
        </message>
        <message>
            <source>{place}: {coordinate!r} is not a number</source>
            <translation type="unfinished">{place} : {coordinate!r} n’est pas un nombre</translation>
        </message>
        <message>
            <source>{place}: {coordinate!r} is not finite</source>
            <translation type="unfinished">{place} : {coordinate!r} n’est pas fini</translation>
        </message>
        <message>
            <source>{path} {error}</source>
            <translation type="unfinished">{path} {error}</translation>
        </message>
        <message>
            <source>{path} is not XML: {error}</source>
            <translation type="unfinished">{path} n’est pas du XML : {error}</translation>
        </message>
        <message>
            <source>device {profile_name} does not reach all of its tilt limit of {profile_tilt_limit_deg:g}°: {error}</source>
            <translation type="unfinished">l’appareil {profile_name} n’atteint pas partout sa limite d’inclinaison de {profile_tilt_limit_deg:g}° : {error}</translation>
        </message>
        <message>
            <source>{effect}: {reason}; left out: {without}</source>
            <translation type="unfinished">{effect} : {reason} ; laissé de côté : {without}</translation>
        </message>
        <message>
            <source>{effect} is called for and absent: {reason}; add it, or say why not: without: {{{effect}: "…"}}</source>
            <translation type="unfinished">{effect} est nécessaire et absent : {reason} ; ajoutez-le, ou dites pourquoi non : without: {{{effect}: "…"}}</translation>
        </message>
        <message>
            <source>exercise {exercise_id}: without: {stranger} is not called for: nothing within reach needs it ({reasons}); take it out</source>
            <translation type="unfinished">exercice {exercise_id} : without: {stranger} n’est pas nécessaire : rien à portée ne le demande ({reasons}) ; enlevez-le</translation>
        </message>
        <message>
            <source>{listed} hold the shaft</source>
            <translation type="unfinished">retiennent la tige de l’aiguille : {listed}</translation>
        </message>
        <message>
            <source>{listed} rub along the shaft</source>
            <translation type="unfinished">frottent le long de la tige de l’aiguille : {listed}</translation>
        </message>
        <message>
            <source>the tip cuts its way: {listed}</source>
            <translation type="unfinished">la pointe coupe son chemin : {listed}</translation>
        </message>
        <message>
            <source>it is pierced: {listed}</source>
            <translation type="unfinished">à percer : {listed}</translation>
        </message>
        <message>
            <source>what is pierced gives way while the needle rests</source>
            <translation type="unfinished">ce qui est percé cède pendant que l’aiguille est au repos</translation>
        </message>
        <message>
            <source>no needle goes through {listed}</source>
            <translation type="unfinished">aucune aiguille ne les traverse : {listed}</translation>
        </message>
        <message>
            <source>along with the breath go {listed}</source>
            <translation type="unfinished">suivent la respiration : {listed}</translation>
        </message>
        <message>
            <source>a bevelled tip cuts a curved way</source>
            <translation type="unfinished">une pointe biseautée coupe un chemin courbe</translation>
        </message>
        <message>
            <source>the student chooses the entry: no layers lie along all paths</source>
            <translation type="unfinished">l’étudiant choisit le point d’entrée : aucune suite de tissus ne vaut pour toutes les trajectoires</translation>
        </message>
        <message>
            <source>{first_names} and {more} more</source>
            <translation type="unfinished">{first_names} et {more} de plus</translation>
        </message>
        <message>
            <source>dials: a schedule needs at least one, such as [0.7, 0.4, 0]</source>
            <translation type="unfinished">dials : un programme demande au moins une valeur, par exemple [0.7, 0.4, 0]</translation>
        </message>
        <message>
            <source>dials go with kind: schedule; performance follows the scores</source>
            <translation type="unfinished">dials va avec kind: schedule ; performance suit les notes</translation>
        </message>
        <message>
            <source>poor ({poor:g}) must not lie above good ({good:g})</source>
            <translation type="unfinished">poor ({poor:g}) ne doit pas dépasser good ({good:g})</translation>
        </message>
        <message>
            <source>probe_every: 1 would make every attempt a probe; give 0, or 2 and up</source>
            <translation type="unfinished">probe_every: 1 ferait de chaque essai un essai témoin ; donnez 0, ou 2 et plus</translation>
        </message>
        <message>
            <source>no exercise {name_or_path!r}; there are {known_ids}, or give the path of a .yaml file</source>
            <translation type="unfinished">il n’y a pas d’exercice {name_or_path!r} ; il y a {known_ids}, ou donnez le chemin d’un fichier .yaml</translation>
        </message>
        <message>
            <source>there is no version {version} of the exercise {identifier!r}; there are: {there}</source>
            <translation type="unfinished">il n’y a pas de version {version} de l’exercice {identifier!r} ; il y a : {there}</translation>
        </message>
        <message>
            <source>{path}: {name}: {reason}</source>
            <translation type="unfinished">{path} : {name} : {reason}</translation>
        </message>
        <message>
            <source> (line {line})</source>
            <translation type="unfinished"> (ligne {line})</translation>
        </message>
        <message>
            <source>{path}: {error}</source>
            <translation type="unfinished">{path} : {error}</translation>
        </message>
        <message>
            <source>{exercise_name!r} is not known; valid names are {names}, or the path of a .yaml file</source>
            <translation type="unfinished">{exercise_name!r} est inconnu ; sont valides {names}, ou le chemin d’un fichier .yaml</translation>
        </message>
        <message>
            <source>give either phantom: {{seed: ...}} or folder: ..., one of the two</source>
            <translation type="unfinished">donnez soit phantom: {{seed: ...}}, soit folder: ..., l’un des deux</translation>
        </message>
        <message>
            <source>folder holds a character that no path has</source>
            <translation type="unfinished">folder contient un caractère qu’aucun chemin n’a</translation>
        </message>
        <message>
            <source>series goes with folder; the phantom has one series only</source>
            <translation type="unfinished">series va avec folder ; le fantôme n’a qu’une série</translation>
        </message>
        <message>
            <source>digest goes with folder; the phantom is known by its seed</source>
            <translation type="unfinished">digest va avec folder ; le fantôme est défini par son seed</translation>
        </message>
        <message>
            <source>remedy goes with folder; the phantom is read as it is</source>
            <translation type="unfinished">remedy va avec folder ; le fantôme est lu tel quel</translation>
        </message>
        <message>
            <source>file names a file of structures</source>
            <translation type="unfinished">file nomme un fichier de structures</translation>
        </message>
        <message>
            <source>rotation_deg must be within ±360°</source>
            <translation type="unfinished">rotation_deg doit être dans ±360°</translation>
        </message>
        <message>
            <source>no needle of {gauge} G; there are {known}</source>
            <translation type="unfinished">il n’y a pas d’aiguille de {gauge} G ; il y a {known}</translation>
        </message>
        <message>
            <source>exercise {exercise_id} has no target to picture</source>
            <translation type="unfinished">l’exercice {exercise_id} n’a pas de cible à montrer</translation>
        </message>
        <message>
            <source>there is no window {window!r}; there are: {presets}, or give {{width: …, level: …}} in HU</source>
            <translation type="unfinished">il n’y a pas de fenêtrage {window!r} ; il y a : {presets}, ou donnez {{width: …, level: …}} en UH</translation>
        </message>
        <message>
            <source>locked keeps window, slab and layout: give at least one of them</source>
            <translation type="unfinished">locked fige window, slab et layout : donnez-en au moins un</translation>
        </message>
        <message>
            <source>exercise {exercise_id} has no plan of its own: the student places the entry in the window; nothing is chosen for him</source>
            <translation type="unfinished">l’exercice {exercise_id} n’a pas de plan à lui : l’étudiant place le point d’entrée dans la fenêtre ; rien n’est choisi pour lui</translation>
        </message>
        <message>
            <source>exercise {exercise_id}: nothing declares the view {view_name!r}; declared are {views}; see 'How to add a view'</source>
            <translation type="unfinished">exercice {exercise_id} : rien ne déclare la vue {view_name!r} ; sont déclarées {views} ; voir « How to add a view »</translation>
        </message>
        <message>
            <source>a list of {info_field_name} holds names only</source>
            <translation type="unfinished">une liste de {info_field_name} ne contient que des noms</translation>
        </message>
        <message>
            <source>one of the {info_field_name} is named twice</source>
            <translation type="unfinished">un nom figure deux fois dans {info_field_name}</translation>
        </message>
        <message>
            <source>no effect is called {name!r}; there are {names}</source>
            <translation type="unfinished">aucun effet ne s’appelle {name!r} ; il y a {names}</translation>
        </message>
        <message>
            <source>{name} is left out without a reason: say why</source>
            <translation type="unfinished">{name} est laissé de côté sans raison : dites pourquoi</translation>
        </message>
        <message>
            <source>without: {effect_name} is left out, and the exercise asks for it: one of the two</source>
            <translation type="unfinished">without: {effect_name} est laissé de côté, et l’exercice le demande : l’un ou l’autre</translation>
        </message>
        <message>
            <source>at least one metric needs a weight above 0</source>
            <translation type="unfinished">au moins un indicateur doit avoir un poids supérieur à 0</translation>
        </message>
        <message>
            <source>structures: {structure_name!r} is a risk twice</source>
            <translation type="unfinished">structures : {structure_name!r} figure deux fois comme risque</translation>
        </message>
        <message>
            <source>locks: an assessment locks all controls, and {free} is missing: leave locks out, or use purpose: practice</source>
            <translation type="unfinished">locks : une évaluation verrouille toutes les commandes, et {free} manque : laissez locks de côté, ou utilisez purpose: practice</translation>
        </message>
        <message>
            <source>fading: an assessment is the same for everybody: leave fading out, or use purpose: practice</source>
            <translation type="unfinished">fading : une évaluation est la même pour tous : laissez fading de côté, ou utilisez purpose: practice</translation>
        </message>
        <message>
            <source>plan {{own: true}} of a CT folder needs target_mm: [x, y, z]</source>
            <translation type="unfinished">plan {{own: true}} d’un dossier CT demande target_mm: [x, y, z]</translation>
        </message>
        <message>
            <source>plan phantom_default needs ct: {{phantom: ...}}; give entry_mm and target_mm</source>
            <translation type="unfinished">plan phantom_default demande ct: {{phantom: ...}} ; donnez entry_mm et target_mm</translation>
        </message>
        <message>
            <source>touch: the targets lie about a path that the file names: give plan entry_mm and target_mm</source>
            <translation type="unfinished">touch : les cibles sont autour d’une trajectoire que le fichier nomme : donnez entry_mm et target_mm dans plan</translation>
        </message>
        <message>
            <source>touch: the targets are touched by sight: use guidance.mode: live</source>
            <translation type="unfinished">touch : les cibles sont touchées à vue : utilisez guidance.mode: live</translation>
        </message>
        <message>
            <source>depth_mm: {near:g} to {far:g} mm; give the smaller one first</source>
            <translation type="unfinished">depth_mm : {near:g} à {far:g} mm ; donnez d’abord la plus petite valeur</translation>
        </message>
        <message>
            <source>give either targets_mm: [[x, y, z], …] or pattern: {{…}}, one of both</source>
            <translation type="unfinished">donnez soit targets_mm: [[x, y, z], …], soit pattern: {{…}}, l’un des deux</translation>
        </message>
        <message>
            <source>touch.pattern: {targets} targets that follow each other {apart:g} radii of {radius_mm:g} mm apart find no room within {pattern_within_deg:g}° and depths of {least_depth_mm:g} to {largest_depth_mm:g} mm; give more room or a smaller radius</source>
            <translation type="unfinished">touch.pattern : cibles : {targets} ; deux qui se suivent, à {apart:g} rayons de {radius_mm:g} mm l’une de l’autre, ne trouvent pas place dans {pattern_within_deg:g}° et à des profondeurs de {least_depth_mm:g} à {largest_depth_mm:g} mm ; donnez plus de place ou un rayon plus petit</translation>
        </message>
        <message>
            <source>touch: target {target_number}: {error}</source>
            <translation type="unfinished">touch : cible {target_number} : {error}</translation>
        </message>
        <message>
            <source>it lies {depth_mm:.1f} mm from the trocar, not {least_mm:g} mm</source>
            <translation type="unfinished">elle est à {depth_mm:.1f} mm du trocart, et non à {least_mm:g} mm</translation>
        </message>
        <message>
            <source>it lies {depth_mm:.1f} mm from the trocar, within its own radius of {radius_mm:g} mm, where a tool that only comes in touches it</source>
            <translation type="unfinished">elle est à {depth_mm:.1f} mm du trocart, moins que son propre rayon de {radius_mm:g} mm : un instrument qui ne fait qu’entrer l’y touche déjà</translation>
        </message>
        <message>
            <source>touch: target {target_number} at [{x:g}, {y:g}, {z:g}] mm cannot be touched with {profile_name}: {reasons}. Reachable are targets {least_depth:g} to {limits_depth_limit_mm:.0f} mm from the entry, by a way that leans at most {limits_tilt_limit_deg:.0f}° from straight down</source>
            <translation type="unfinished">touch : la cible {target_number} en [{x:g}, {y:g}, {z:g}] mm ne peut pas être touchée avec {profile_name} : {reasons}. Sont accessibles les cibles à {least_depth:g} à {limits_depth_limit_mm:.0f} mm du point d’entrée, par un chemin incliné d’au plus {limits_tilt_limit_deg:.0f}° par rapport à la verticale</translation>
        </message>
        <message>
            <source>touch: targets {first} and {second} lie {gap:.1f} mm apart; with a radius of {radius_mm:g} mm a tip that stays touches both: lay them more than {least_gap_mm:g} mm apart, or give a smaller radius_mm</source>
            <translation type="unfinished">touch : les cibles {first} et {second} sont à {gap:.1f} mm l’une de l’autre ; avec un rayon de {radius_mm:g} mm, une pointe immobile touche les deux : éloignez-les de plus de {least_gap_mm:g} mm, ou donnez un radius_mm plus petit</translation>
        </message>
        <message>
            <source>exercise {exercise_id} would be a file of {size_kb} kB; {largest_file} kB are the most: shorten its texts</source>
            <translation type="unfinished">l’exercice {exercise_id} ferait un fichier de {size_kb} ko ; {largest_file} ko sont le maximum : raccourcissez ses textes</translation>
        </message>
        <message>
            <source>exercise {exercise_id} cannot be written as YAML: it reads back otherwise</source>
            <translation type="unfinished">l’exercice {exercise_id} ne peut pas être écrit en YAML : relu, il est différent</translation>
        </message>
        <message>
            <source>id: {exercise_id!r} is an exercise that comes with Acus and stays as it is: save yours under another id (duplicate it)</source>
            <translation type="unfinished">id : {exercise_id!r} est un exercice fourni avec Acus et reste tel quel : enregistrez le vôtre sous un autre identifiant (dupliquez-le)</translation>
        </message>
        <message>
            <source>{path} is there and cannot be used: repair it (acus exercise validate {path}) or move it away, then save again</source>
            <translation type="unfinished">{path} existe et ne peut pas être utilisé : réparez-le (acus exercise validate {path}) ou déplacez-le, puis enregistrez à nouveau</translation>
        </message>
        <message>
            <source>cannot write in {folder}: {error_strerror}; ACUS_DATA moves it</source>
            <translation type="unfinished">impossible d’écrire dans {folder} : {error_strerror} ; ACUS_DATA permet de le déplacer</translation>
        </message>
        <message>
            <source>its slices differ in {names}: neighbours may not compare</source>
            <translation type="unfinished">ses coupes diffèrent par {names} : deux voisines ne sont peut-être pas comparables</translation>
        </message>
        <message>
            <source>{doubled} different images share a SOPInstanceUID</source>
            <translation type="unfinished">images différentes partageant un SOPInstanceUID : {doubled}</translation>
        </message>
        <message>
            <source>1 file is a copy and left out</source>
            <translation type="unfinished">1 fichier est une copie et n’est pas pris</translation>
        </message>
        <message>
            <source>{count} files are copies and left out</source>
            <translation type="unfinished">{count} fichiers sont des copies et ne sont pas pris</translation>
        </message>
        <message>
            <source>there is no body in this CT, so there is no skin</source>
            <translation type="unfinished">il n’y a pas de corps dans ce CT, donc pas de peau</translation>
        </message>
        <message>
            <source>looking for the body</source>
            <translation type="unfinished">recherche du corps</translation>
        </message>
        <message>
            <source>taking the table away</source>
            <translation type="unfinished">retrait de la table</translation>
        </message>
        <message>
            <source>filling the lungs</source>
            <translation type="unfinished">remplissage des poumons</translation>
        </message>
        <message>
            <source>body found</source>
            <translation type="unfinished">corps trouvé</translation>
        </message>
        <message>
            <source>the line starts in the body, {depth:.1f} mm from the skin</source>
            <translation type="unfinished">la ligne commence dans le corps, à {depth:.1f} mm de la peau</translation>
        </message>
        <message>
            <source>the line never meets the body; its end is {distance:.1f} mm from the skin</source>
            <translation type="unfinished">la ligne ne rencontre jamais le corps ; son extrémité est à {distance:.1f} mm de la peau</translation>
        </message>
        <message>
            <source>the entry lies {distance:.1f} mm {where}; click within {tolerance_mm:g} mm of the skin</source>
            <translation type="unfinished">le point d’entrée est à {distance:.1f} mm de la peau ({where}) ; cliquez à {tolerance_mm:g} mm de la peau au plus</translation>
        </message>
        <message>
            <source>its pixels cannot be decoded ({fault})</source>
            <translation type="unfinished">ses pixels ne peuvent pas être décodés ({fault})</translation>
        </message>
        <message>
            <source>decodes to {size} pixels where {out_size} are needed</source>
            <translation type="unfinished">donne {size} pixels une fois décodé, il en faut {out_size}</translation>
        </message>
        <message>
            <source>a decoder for transfer syntax {syntax} is missing: pip install {package}</source>
            <translation type="unfinished">il manque un décodeur pour la syntaxe de transfert {syntax} : pip install {package}</translation>
        </message>
        <message>
            <source>its pixels are compressed as {found_compression}, and its transfer syntax is of {stated_compression}; have it sent again</source>
            <translation type="unfinished">ses pixels sont compressés en {found_compression}, et sa syntaxe de transfert vaut pour {stated_compression} ; faites-le renvoyer</translation>
        </message>
        <message>
            <source>its compressed pixels are damaged (no frame header)</source>
            <translation type="unfinished">ses pixels compressés sont endommagés (pas d’en-tête de trame)</translation>
        </message>
        <message>
            <source>its compressed picture is {columns} × {rows}, its header says {form_columns} × {form_rows}</source>
            <translation type="unfinished">son image compressée fait {columns} × {rows}, son en-tête dit {form_columns} × {form_rows}</translation>
        </message>
        <message>
            <source>{samples} samples per compressed pixel, its header says {form_samples}</source>
            <translation type="unfinished">valeurs par pixel compressé : {samples}, son en-tête dit {form_samples}</translation>
        </message>
        <message>
            <source>{precision} bits per compressed pixel do not fit BitsAllocated {form_bits_allocated}</source>
            <translation type="unfinished">bits par pixel compressé : {precision}, ce qui ne va pas avec BitsAllocated {form_bits_allocated}</translation>
        </message>
        <message>
            <source>its compressed pixels are damaged (no RLE header)</source>
            <translation type="unfinished">ses pixels compressés sont endommagés (pas d’en-tête RLE)</translation>
        </message>
        <message>
            <source>{segments} RLE segments where {wanted} are needed</source>
            <translation type="unfinished">segments RLE : {segments}, il en faut {wanted}</translation>
        </message>
        <message>
            <source>{header_path} cannot be read: {error_strerror}</source>
            <translation type="unfinished">impossible de lire {header_path} : {error_strerror}</translation>
        </message>
        <message>
            <source>{header_path} has changed since the folder was searched; search it again</source>
            <translation type="unfinished">{header_path} a changé depuis l’examen du dossier ; examinez-le à nouveau</translation>
        </message>
        <message>
            <source>{header_path}: {header_pixels_damage}</source>
            <translation type="unfinished">{header_path} : {header_pixels_damage}</translation>
        </message>
        <message>
            <source>{header_path} ends {missing_bytes} bytes too early; read it again</source>
            <translation type="unfinished">{header_path} se termine {missing_bytes} octets trop tôt ; relisez-le</translation>
        </message>
        <message>
            <source>{header_path}: {error}</source>
            <translation type="unfinished">{header_path} : {error}</translation>
        </message>
        <message>
            <source>{header_path} inflates to {needed} bytes too few</source>
            <translation type="unfinished">{header_path} donne {needed} octets de trop peu une fois décompressé</translation>
        </message>
        <message>
            <source>{header_path} cannot be decoded ({brief})</source>
            <translation type="unfinished">{header_path} ne peut pas être décodé ({brief})</translation>
        </message>
        <message>
            <source>its data set is not deflated as its transfer syntax says, or damaged ({error})</source>
            <translation type="unfinished">son jeu de données n’est pas compressé (deflate) comme le dit sa syntaxe de transfert, ou il est endommagé ({error})</translation>
        </message>
        <message>
            <source>its header cannot be read ({brief})</source>
            <translation type="unfinished">son en-tête ne peut pas être lu ({brief})</translation>
        </message>
        <message>
            <source>its transfer syntax says {stated_order} endian, and its header is {found_order} endian; have it sent again</source>
            <translation type="unfinished">sa syntaxe de transfert dit {stated_order} endian, et son en-tête est {found_order} endian ; faites-le renvoyer</translation>
        </message>
        <message>
            <source>{name} is {quantity:g}{unit}; its size must lie between {least:g} and {most:g}{unit}</source>
            <translation type="unfinished">{name} vaut {quantity:g}{unit} ; sa valeur absolue doit être entre {least:g} et {most:g}{unit}</translation>
        </message>
        <message>
            <source>{name} does not hold finite numbers{wanted}{quoted}</source>
            <translation type="unfinished">{name} ne contient pas de nombres finis{wanted}{quoted}</translation>
        </message>
        <message>
            <source>{name} has {byte_length} bytes; 2 are needed</source>
            <translation type="unfinished">{name} a {byte_length} octets ; il en faut 2</translation>
        </message>
        <message>
            <source>{name} is not an integer</source>
            <translation type="unfinished">{name} n’est pas un entier</translation>
        </message>
        <message>
            <source>ImageOrientationPatient {orientation} is not two perpendicular unit vectors</source>
            <translation type="unfinished">ImageOrientationPatient {orientation} n’est pas deux vecteurs unitaires perpendiculaires</translation>
        </message>
        <message>
            <source>{keyword} of a frame is not {count} finite numbers</source>
            <translation type="unfinished">{keyword} d’une image : il faut des nombres finis, au nombre de {count}</translation>
        </message>
        <message>
            <source>NumberOfFrames is {stated_frames}, and {described_frames} frames are described</source>
            <translation type="unfinished">NumberOfFrames vaut {stated_frames}, et le nombre d’images décrites est {described_frames}</translation>
        </message>
        <message>
            <source>PixelSpacing is {spacing}; both must be above zero</source>
            <translation type="unfinished">PixelSpacing vaut {spacing} ; les deux valeurs doivent être supérieures à zéro</translation>
        </message>
        <message>
            <source>RescaleSlope is 0; every pixel would have the same value</source>
            <translation type="unfinished">RescaleSlope vaut 0 ; tous les pixels auraient la même valeur</translation>
        </message>
        <message>
            <source>the values of this volume are in {volume_unit}, not in HU: tissue is told by Hounsfield values; give the layers by hand</source>
            <translation type="unfinished">les valeurs de ce volume sont en {volume_unit}, pas en UH : les tissus se reconnaissent à leurs valeurs Hounsfield ; donnez les couches à la main</translation>
        </message>
        <message>
            <source>there is no body in this CT: all of it is air</source>
            <translation type="unfinished">il n’y a pas de corps dans ce CT : tout est de l’air</translation>
        </message>
        <message>
            <source>reading the CT on the field's grid</source>
            <translation type="unfinished">lecture du CT sur la grille du champ</translation>
        </message>
        <message>
            <source>looking for the skin</source>
            <translation type="unfinished">recherche de la peau</translation>
        </message>
        <message>
            <source>looking for lung and gut</source>
            <translation type="unfinished">recherche du poumon et de l’intestin</translation>
        </message>
        <message>
            <source>looking for bone</source>
            <translation type="unfinished">recherche des os</translation>
        </message>
        <message>
            <source>parting fat, muscle and organs</source>
            <translation type="unfinished">séparation de la graisse, du muscle et des organes</translation>
        </message>
        <message>
            <source>laying structures over it</source>
            <translation type="unfinished">superposition des structures</translation>
        </message>
        <message>
            <source>placing the boundaries</source>
            <translation type="unfinished">mise en place des limites</translation>
        </message>
        <message>
            <source>the tissue field is made</source>
            <translation type="unfinished">champ de tissus prêt</translation>
        </message>
        <message>
            <source>no bone was found: no needle can be told that it met one</source>
            <translation type="unfinished">aucun os n’a été trouvé : on ne pourra pas dire que l’aiguille en a rencontré un</translation>
        </message>
        <message>
            <source>no lung was found within reach</source>
            <translation type="unfinished">aucun poumon n’a été trouvé à portée</translation>
        </message>
        <message>
            <source>bright tissue without cortex may be bone or contrast: mark it to be sure</source>
            <translation type="unfinished">un tissu clair sans corticale peut être de l’os ou du produit de contraste : marquez-le pour être sûr</translation>
        </message>
        <message>
            <source>labelling the built-in patient</source>
            <translation type="unfinished">attribution des tissus du patient intégré</translation>
        </message>
        <message>
            <source>a field of {spacing_mm:g} mm: {named} mm can be chosen</source>
            <translation type="unfinished">un champ de {spacing_mm:g} mm : on peut choisir {named} mm</translation>
        </message>
        <message>
            <source>a reach of {reach_mm:g} mm: more than 0 and less than 2000 mm are</source>
            <translation type="unfinished">une portée de {reach_mm:g} mm : il faut plus de 0 et moins de 2000 mm</translation>
        </message>
        <message>
            <source>entry {entry_mm} mm lies outside the CT: move it</source>
            <translation type="unfinished">le point d’entrée {entry_mm} mm est hors du CT : déplacez-le</translation>
        </message>
        <message>
            <source>the CT ends {to_end_mm:.0f} mm from the entry, within the body, and the needle reaches {reach_mm:.0f} mm: what lies beyond is unknown</source>
            <translation type="unfinished">le CT se termine à {to_end_mm:.0f} mm du point d’entrée, dans le corps, et l’aiguille atteint {reach_mm:.0f} mm : ce qui est au-delà est inconnu</translation>
        </message>
        <message>
            <source>the CT is {thickness_mm:.1f} mm thick: no field of {spacing_mm:g} mm fits</source>
            <translation type="unfinished">le CT fait {thickness_mm:.1f} mm d’épaisseur : un champ de {spacing_mm:g} mm n’y tient pas</translation>
        </message>
        <message>
            <source>looking for the tissue field in the cache</source>
            <translation type="unfinished">recherche du champ de tissus dans le cache</translation>
        </message>
        <message>
            <source>the tissue field was there</source>
            <translation type="unfinished">champ de tissus déjà présent</translation>
        </message>
        <message>
            <source>a tissue field of {grid_spacing_mm:g} mm takes {megabytes:.0f} MB here; {most_mb:g} are allowed: {advice}</source>
            <translation type="unfinished">un champ de tissus de {grid_spacing_mm:g} mm prend ici {megabytes:.0f} Mo ; {most_mb:g} sont permis : {advice}</translation>
        </message>
        <message>
            <source>making a tissue field of {grid_spacing_mm:g} mm takes {grid_voxels:.1f} GB of memory, and {free:.1f} GB are free: {advice}</source>
            <translation type="unfinished">calculer un champ de tissus de {grid_spacing_mm:g} mm demande {grid_voxels:.1f} Go de mémoire, et {free:.1f} Go sont libres : {advice}</translation>
        </message>
        <message>
            <source>structure {tissue_words} lies beyond the reach</source>
            <translation type="unfinished">la structure {tissue_words} est hors de portée</translation>
        </message>
        <message>
            <source>{structures} structures: a field has room for {most_structures}</source>
            <translation type="unfinished">structures : {structures} ; un champ a de la place pour {most_structures}</translation>
        </message>
        <message>
            <source>structures {over} and {under} overlap by {millilitres:.2g} ml, which count as {over}</source>
            <translation type="unfinished">les structures {over} et {under} se recouvrent de {millilitres:.2g} ml, qui comptent comme {over}</translation>
        </message>
        <message>
            <source>this is no tissue field: it does not begin as one</source>
            <translation type="unfinished">ce n’est pas un champ de tissus : il ne commence pas comme il faut</translation>
        </message>
        <message>
            <source>the tissue field is damaged ({error_name})</source>
            <translation type="unfinished">le champ de tissus est endommagé ({error_name})</translation>
        </message>
        <message>
            <source>a tissue field of {shape} voxels is none that can be read</source>
            <translation type="unfinished">un champ de tissus de {shape} voxels ne peut pas être lu</translation>
        </message>
        <message>
            <source>the tissue field is damaged: a part of it is not what was written</source>
            <translation type="unfinished">le champ de tissus est endommagé : une partie n’est pas ce qui a été écrit</translation>
        </message>
        <message>
            <source>the tissue field is another than its digest says</source>
            <translation type="unfinished">le champ de tissus n’est pas celui que dit son empreinte</translation>
        </message>
        <message>
            <source>the tissue field holds more than its {most} voxels</source>
            <translation type="unfinished">le champ de tissus contient plus que ses {most} voxels</translation>
        </message>
        <message>
            <source>labels of {labels_shape}, distances of {distance_shape} voxels: both need one shape (nz, ny, nx) of two voxels at least</source>
            <translation type="unfinished">étiquettes de {labels_shape}, distances de {distance_shape} voxels : les deux demandent une même forme (nz, ny, nx) d’au moins deux voxels</translation>
        </message>
        <message>
            <source>labels are {labels_dtype} and distances {distance_dtype}; uint8 and int8 are needed</source>
            <translation type="unfinished">les étiquettes sont {labels_dtype} et les distances {distance_dtype} ; il faut uint8 et int8</translation>
        </message>
        <message>
            <source>the table of tissues has the codes {codes}; row = code is needed</source>
            <translation type="unfinished">la table des tissus a les codes {codes} ; il faut ligne = code</translation>
        </message>
        <message>
            <source>code 0 is {tissues_first_words}; it must be unknown</source>
            <translation type="unfinished">le code 0 est {tissues_first_words} ; il doit être inconnu</translation>
        </message>
        <message>
            <source>label {largest} has no row in the table of {tissues} tissues</source>
            <translation type="unfinished">l’étiquette {largest} n’a pas de ligne dans la table des tissus (tissus : {tissues})</translation>
        </message>
        <message>
            <source>a distance is negative; they have no sign</source>
            <translation type="unfinished">une distance est négative ; elles n’ont pas de signe</translation>
        </message>
        <message>
            <source>affine_mm {affine} is singular</source>
            <translation type="unfinished">affine_mm {affine} est singulière</translation>
        </message>
        <message>
            <source>the volume needs {size:.1f} GB of memory, which this machine cannot give</source>
            <translation type="unfinished">le volume demande {size:.1f} Go de mémoire, que cette machine ne peut pas donner</translation>
        </message>
        <message>
            <source>slice {ready} of {count}</source>
            <translation type="unfinished">coupe {ready} sur {count}</translation>
        </message>
        <message>
            <source>pydicom is loaded</source>
            <translation type="unfinished">pydicom est chargé</translation>
        </message>
        <message>
            <source>{absent} {verb} missing, without which its pixels cannot be told</source>
            <translation type="unfinished">{absent} {verb} introuvable(s) ; sans cela, ses pixels ne peuvent pas être interprétés</translation>
        </message>
        <message>
            <source>PixelRepresentation is {representation}; it must be 0 or 1</source>
            <translation type="unfinished">PixelRepresentation vaut {representation} ; il faut 0 ou 1</translation>
        </message>
        <message>
            <source>the library {library} cannot be written: {reason}</source>
            <translation type="unfinished">impossible d’écrire dans la bibliothèque {library} : {reason}</translation>
        </message>
        <message>
            <source>{reason}; nothing was kept</source>
            <translation type="unfinished">{reason} ; rien n’a été gardé</translation>
        </message>
        <message>
            <source>a file of the series is gone: the folder was moved or its medium taken out; nothing was kept</source>
            <translation type="unfinished">un fichier de la série a disparu : le dossier a été déplacé ou son support retiré ; rien n’a été gardé</translation>
        </message>
        <message>
            <source>the disk of the library has {free:.0f} MB free, this series needs {needed:.0f} MB; make room, nothing was kept</source>
            <translation type="unfinished">le disque de la bibliothèque a {free:.0f} Mo libres, cette série en demande {needed:.0f} ; faites de la place, rien n’a été gardé</translation>
        </message>
        <message>
            <source>the disk of the library is full</source>
            <translation type="unfinished">le disque de la bibliothèque est plein</translation>
        </message>
        <message>
            <source>all {stored_images} images of this series are in the library already; the {given_images} given are a part of them</source>
            <translation type="unfinished">toutes les images de cette série ({stored_images}) sont déjà dans la bibliothèque ; celles données ({given_images}) en font partie</translation>
        </message>
        <message>
            <source>was in the library already, image for image</source>
            <translation type="unfinished">était déjà dans la bibliothèque, image pour image</translation>
        </message>
        <message>
            <source>taken into the library, in place of {earlier_images} of its {new_images} images that lay there</source>
            <translation type="unfinished">ajoutée à la bibliothèque ({new_images} images), à la place des {earlier_images} qui s’y trouvaient</translation>
        </message>
        <message>
            <source>taken into the library</source>
            <translation type="unfinished">ajoutée à la bibliothèque</translation>
        </message>
        <message>
            <source>no CT {name!r} in the library; it holds {valid}</source>
            <translation type="unfinished">il n’y a pas de CT {name!r} dans la bibliothèque ; elle contient {valid}</translation>
        </message>
        <message>
            <source>{files} files taken into the library</source>
            <translation type="unfinished">fichiers ajoutés à la bibliothèque : {files}</translation>
        </message>
        <message>
            <source>this series is not taken into the library: {name} differs among its files, and they would get one pseudonym; give the files of one patient's study alone</source>
            <translation type="unfinished">cette série n’est pas ajoutée à la bibliothèque : {name} diffère d’un fichier à l’autre, et tous auraient le même pseudonyme ; ne donnez que les fichiers de l’examen d’un seul patient</translation>
        </message>
        <message>
            <source>{series_reason}; {reason}</source>
            <translation type="unfinished">{series_reason} ; {reason}</translation>
        </message>
        <message>
            <source>this series cannot be used: {series_reason}{offer}</source>
            <translation type="unfinished">cette série ne peut pas être utilisée : {series_reason}{offer}</translation>
        </message>
        <message>
            <source>the library holds {stored_images} images of this series as {name}; of the {given_images} given {known_images} are among them and {images_not_given} of those there are not given: give all images of the series at once, or remove what lies there first (acus library remove {name}); nothing was changed</source>
            <translation type="unfinished">la bibliothèque contient {stored_images} images de cette série sous le nom {name} ; des {given_images} données, {known_images} en font partie, et {images_not_given} de celles qui s’y trouvent n’ont pas été données : donnez toutes les images de la série à la fois, ou retirez d’abord ce qui s’y trouve (acus library remove {name}) ; rien n’a été modifié</translation>
        </message>
        <message>
            <source>{error}; nothing was kept</source>
            <translation type="unfinished">{error} ; rien n’a été gardé</translation>
        </message>
        <message>
            <source>checking what was written</source>
            <translation type="unfinished">vérification de ce qui a été écrit</translation>
        </message>
        <message>
            <source> beside the {open:.1f} GB of what is open</source>
            <translation type="unfinished"> en plus des {open:.1f} Go de ce qui est ouvert</translation>
        </message>
        <message>
            <source>needs {bytes:.1f} GB of memory, and {available:.1f} GB are free{beside}; fits with {i} × {j} × {k} voxels taken together</source>
            <translation type="unfinished">demande {bytes:.1f} Go de mémoire, et {available:.1f} Go sont libres{beside} ; tient si {i} × {j} × {k} voxels sont regroupés</translation>
        </message>
        <message>
            <source>series {series_key} cannot be used: {series_reason}</source>
            <translation type="unfinished">la série {series_key} ne peut pas être utilisée : {series_reason}</translation>
        </message>
        <message>
            <source>{path_name} {too_large}</source>
            <translation type="unfinished">{path_name} {too_large}</translation>
        </message>
        <message>
            <source>reading {name}</source>
            <translation type="unfinished">lecture de {name}</translation>
        </message>
        <message>
            <source>{path} cannot be read: {error_strerror}</source>
            <translation type="unfinished">impossible de lire {path} : {error_strerror}</translation>
        </message>
        <message>
            <source>{path} has changed since it was found; open it again</source>
            <translation type="unfinished">{path} a changé depuis qu’il a été trouvé ; rouvrez-le</translation>
        </message>
        <message>
            <source>{name} read</source>
            <translation type="unfinished">{name} lu</translation>
        </message>
        <message>
            <source>reading</source>
            <translation type="unfinished">lecture</translation>
        </message>
        <message>
            <source>it is cut off or damaged</source>
            <translation type="unfinished">il est tronqué ou endommagé</translation>
        </message>
        <message>
            <source>slice {current} of {size}</source>
            <translation type="unfinished">coupe {current} sur {size}</translation>
        </message>
        <message>
            <source>it holds values that are no numbers (NaN or infinite)</source>
            <translation type="unfinished">il contient des valeurs qui ne sont pas des nombres (NaN ou infini)</translation>
        </message>
        <message>
            <source>it holds the value {largest:g}; {most_value:g} is the most that is read</source>
            <translation type="unfinished">il contient la valeur {largest:g} ; on lit au plus {most_value:g}</translation>
        </message>
        <message>
            <source>it is not a regular file</source>
            <translation type="unfinished">ce n’est pas un fichier ordinaire</translation>
        </message>
        <message>
            <source>it is {format_name}, not NIfTI</source>
            <translation type="unfinished">c’est du {format_name}, pas du NIfTI</translation>
        </message>
        <message>
            <source>has sizes {shape}; one volume is read, no times or vectors</source>
            <translation type="unfinished">a les tailles {shape} ; on lit un seul volume, sans temps ni vecteurs</translation>
        </message>
        <message>
            <source>has {shape} slices; a volume needs at least two</source>
            <translation type="unfinished">coupes : {shape} ; un volume en demande au moins deux</translation>
        </message>
        <message>
            <source>holds {kind}, not one number for each voxel</source>
            <translation type="unfinished">contient {kind}, pas un nombre par voxel</translation>
        </message>
        <message>
            <source>a picture of {columns} x {rows} pixels has no pixels</source>
            <translation type="unfinished">une image de {columns} x {rows} pixels n’a pas de pixels</translation>
        </message>
        <message>
            <source>out is {picture_dtype} of shape {picture_shape}; contiguous float32 of shape {shape} is needed</source>
            <translation type="unfinished">out est {picture_dtype} de forme {picture_shape} ; il faut du float32 contigu de forme {shape}</translation>
        </message>
        <message>
            <source>{view} slice {index} does not exist; slices 0 to {count} do</source>
            <translation type="unfinished">la coupe {index} ({view}) n’existe pas ; il y a les coupes 0 à {count}</translation>
        </message>
        <message>
            <source>{view} slices {first} to {last} do not exist; slices 0 to {count} do</source>
            <translation type="unfinished">les coupes {first} à {last} ({view}) n’existent pas ; il y a les coupes 0 à {count}</translation>
        </message>
        <message>
            <source>port {settings_own_port} on {address} cannot be used to receive pictures: {error_strerror}; name another as own_port, or retrieve with C-GET</source>
            <translation type="unfinished">le port {settings_own_port} sur {address} ne peut pas servir à recevoir des images : {error_strerror} ; donnez-en un autre comme own_port, ou récupérez par C-GET</translation>
        </message>
        <message>
            <source>connecting to {name}</source>
            <translation type="unfinished">connexion à {name}</translation>
        </message>
        <message>
            <source>{settings_name}: {limits_problem}; nothing was taken into the library</source>
            <translation type="unfinished">{settings_name} : {limits_problem} ; rien n’a été ajouté à la bibliothèque</translation>
        </message>
        <message>
            <source>{settings_name} refused while {doing}: {refusal}</source>
            <translation type="unfinished">{settings_name} a refusé ({doing}) : {refusal}</translation>
        </message>
        <message>
            <source>{settings_name} gave no answer while {doing}: the connection was lost, or it was silent for {settings_timeout_s:g} s; nothing was taken into the library</source>
            <translation type="unfinished">{settings_name} n’a pas répondu ({doing}) : la connexion a été perdue, ou rien n’est venu pendant {settings_timeout_s:g} s ; rien n’a été ajouté à la bibliothèque</translation>
        </message>
        <message>
            <source>{where} rejects the connection of {settings_own_title} to {settings_title}: {reason}</source>
            <translation type="unfinished">{where} rejette la connexion de {settings_own_title} à {settings_title} : {reason}</translation>
        </message>
        <message>
            <source>{where} supports nothing of what is needed for this request</source>
            <translation type="unfinished">{where} ne prend en charge rien de ce que demande cette requête</translation>
        </message>
        <message>
            <source>; perhaps it wants a certificate of our own (tls: certificate, key)</source>
            <translation type="unfinished">; il veut peut-être un certificat à nous (tls: certificate, key)</translation>
        </message>
        <message>
            <source>; perhaps that port wants TLS</source>
            <translation type="unfinished">; ce port demande peut-être TLS</translation>
        </message>
        <message>
            <source>{where} cannot be reached: something listens there, but it does not answer as a DICOM service{wish}</source>
            <translation type="unfinished">{where} est injoignable : quelque chose y écoute, mais ne répond pas comme un service DICOM{wish}</translation>
        </message>
        <message>
            <source>{where}: {reason}</source>
            <translation type="unfinished">{where} : {reason}</translation>
        </message>
        <message>
            <source>no way leads from this computer to {settings_host}: {error_strerror}</source>
            <translation type="unfinished">aucun chemin ne mène de cet ordinateur à {settings_host} : {error_strerror}</translation>
        </message>
        <message>
            <source>more than {most_studies} studies match; narrow the search by date or patient</source>
            <translation type="unfinished">plus de {most_studies} examens correspondent ; limitez la recherche par date ou par patient</translation>
        </message>
        <message>
            <source>{settings_name} has no such study or series</source>
            <translation type="unfinished">{settings_name} n’a pas cet examen ou cette série</translation>
        </message>
        <message>
            <source>{settings_name} cancelled the retrieval</source>
            <translation type="unfinished">{settings_name} a annulé la récupération</translation>
        </message>
        <message>
            <source>sending the pictures</source>
            <translation type="unfinished">envoi des images</translation>
        </message>
        <message>
            <source>{settings_name}: {problem}; nothing was taken into the library</source>
            <translation type="unfinished">{settings_name} : {problem} ; rien n’a été ajouté à la bibliothèque</translation>
        </message>
        <message>
            <source>{name} did not send {missing_pictures} of {listed_pictures} pictures; repeat the retrieval: only those are fetched{refused}</source>
            <translation type="unfinished">{name} n’a pas envoyé toutes les images (manquantes : {missing_pictures}, annoncées : {listed_pictures}) ; recommencez la récupération : seules celles-là sont demandées{refused}</translation>
        </message>
        <message>
            <source>{name} sent nothing{refused}</source>
            <translation type="unfinished">{name} n’a rien envoyé{refused}</translation>
        </message>
        <message>
            <source>{settings_name} gave more than {most_pictures} answers while {doing}</source>
            <translation type="unfinished">{settings_name} a donné plus de {most_pictures} réponses ({doing})</translation>
        </message>
        <message>
            <source>{ready} of {total} pictures received</source>
            <translation type="unfinished">{ready} images reçues sur {total}</translation>
        </message>
        <message>
            <source>{ready} pictures received</source>
            <translation type="unfinished">Images reçues : {ready}</translation>
        </message>
        <message>
            <source>{settings_name}: C-MOVE with TLS needs a certificate of our own (tls: certificate, key); or retrieve with C-GET</source>
            <translation type="unfinished">{settings_name} : C-MOVE avec TLS demande un certificat à nous (tls: certificate, key) ; ou récupérez par C-GET</translation>
        </message>
        <message>
            <source>its certificate is not trusted: {error_verify_message}</source>
            <translation type="unfinished">son certificat n’est pas reconnu : {error_verify_message}</translation>
        </message>
        <message>
            <source>no encrypted connection comes about ({reason}); is that its TLS port?</source>
            <translation type="unfinished">aucune connexion chiffrée ne s’établit ({reason}) ; est-ce bien son port TLS ?</translation>
        </message>
        <message>
            <source>it does not answer to TLS; is that its TLS port?</source>
            <translation type="unfinished">il ne répond pas à TLS ; est-ce bien son port TLS ?</translation>
        </message>
        <message>
            <source>it closes the connection when TLS begins; is that its TLS port?</source>
            <translation type="unfinished">il ferme la connexion dès que TLS commence ; est-ce bien son port TLS ?</translation>
        </message>
        <message>
            <source>it holds no certificate in PEM</source>
            <translation type="unfinished">il ne contient pas de certificat en PEM</translation>
        </message>
        <message>
            <source>it cannot be read: {reason}</source>
            <translation type="unfinished">il ne peut pas être lu : {reason}</translation>
        </message>
        <message>
            <source>tls {name} {file}: {reason}</source>
            <translation type="unfinished">tls {name} {file} : {reason}</translation>
        </message>
        <message>
            <source>it sent an object that is no CT or MR picture</source>
            <translation type="unfinished">il a envoyé un objet qui n’est pas une image CT ou IRM</translation>
        </message>
        <message>
            <source>it sent a picture that it had not listed</source>
            <translation type="unfinished">il a envoyé une image qu’il n’avait pas annoncée</translation>
        </message>
        <message>
            <source>it sent more than {most_pictures} pictures</source>
            <translation type="unfinished">il a envoyé plus de {most_pictures} images</translation>
        </message>
        <message>
            <source>it sent a file of more than {largest_picture} GB</source>
            <translation type="unfinished">il a envoyé un fichier de plus de {largest_picture} Go</translation>
        </message>
        <message>
            <source>the disk is full</source>
            <translation type="unfinished">le disque est plein</translation>
        </message>
        <message>
            <source>it sent two different pictures under one name</source>
            <translation type="unfinished">il a envoyé deux images différentes sous un même nom</translation>
        </message>
        <message>
            <source>it sent the same pictures again and again</source>
            <translation type="unfinished">il a envoyé sans cesse les mêmes images</translation>
        </message>
        <message>
            <source>a picture cannot be kept: {error_strerror}</source>
            <translation type="unfinished">une image ne peut pas être gardée : {error_strerror}</translation>
        </message>
        <message>
            <source>it sent something that is no DICOM data set</source>
            <translation type="unfinished">il a envoyé quelque chose qui n’est pas un jeu de données DICOM</translation>
        </message>
        <message>
            <source>it sent a picture under another one's name</source>
            <translation type="unfinished">il a envoyé une image sous le nom d’une autre</translation>
        </message>
        <message>
            <source>it sent a picture of another series</source>
            <translation type="unfinished">il a envoyé une image d’une autre série</translation>
        </message>
        <message>
            <source>it sent a picture of another study</source>
            <translation type="unfinished">il a envoyé une image d’un autre examen</translation>
        </message>
        <message>
            <source>it sent pictures of several patients</source>
            <translation type="unfinished">il a envoyé des images de plusieurs patients</translation>
        </message>
        <message>
            <source>date {date!r}: use YYYYMMDD, or a range YYYYMMDD-YYYYMMDD</source>
            <translation type="unfinished">date {date!r} : écrivez YYYYMMDD, ou un intervalle YYYYMMDD-YYYYMMDD</translation>
        </message>
        <message>
            <source>say what to look for: a patient, a date, an accession number or a study; a list of everything would be thousands of patients</source>
            <translation type="unfinished">dites quoi chercher : un patient, une date, un numéro d’accession ou un examen ; une liste de tout ferait des milliers de patients</translation>
        </message>
        <message>
            <source>no PACS is configured; acus pacs add NAME --host HOST --port PORT --title AE writes {pacs_path}</source>
            <translation type="unfinished">aucun PACS n’est configuré ; acus pacs add NAME --host HOST --port PORT --title AE écrit {pacs_path}</translation>
        </message>
        <message>
            <source>no PACS {name!r}</source>
            <translation type="unfinished">il n’y a pas de PACS {name!r}</translation>
        </message>
        <message>
            <source>name one of the PACS: {names}</source>
            <translation type="unfinished">nommez l’un des PACS : {names}</translation>
        </message>
        <message>
            <source>it cannot process the request</source>
            <translation type="unfinished">il ne peut pas traiter la requête</translation>
        </message>
        <message>
            <source>an unknown answer</source>
            <translation type="unfinished">une réponse inconnue</translation>
        </message>
        <message>
            <source>{pacs_settings_name} sent nothing that can be read</source>
            <translation type="unfinished">{pacs_settings_name} n’a rien envoyé de lisible</translation>
        </message>
        <message>
            <source>this series cannot be used: {series_reason}</source>
            <translation type="unfinished">cette série ne peut pas être utilisée : {series_reason}</translation>
        </message>
        <message>
            <source>this series cannot be used as it is: {series_reason}{offer}; what has come is kept aside for a day and not fetched again</source>
            <translation type="unfinished">cette série ne peut pas être utilisée telle quelle : {series_reason}{offer} ; ce qui est arrivé est gardé un jour et ne sera pas redemandé</translation>
        </message>
        <message>
            <source>no lesion with a safe path was found for phantom seed {seed}; take another</source>
            <translation type="unfinished">aucune lésion à trajectoire sûre n’a été trouvée pour le fantôme de graine {seed} ; prenez-en une autre</translation>
        </message>
        <message>
            <source>phantom seed {seed}, {slices} slices, {rows} rows: the seed must be 0 or more, slices 2 to 2000 and rows 16 to 2048</source>
            <translation type="unfinished">fantôme de graine {seed}, {slices} coupes, {rows} lignes : la graine doit être supérieure ou égale à 0, les coupes de 2 à 2000 et les lignes de 16 à 2048</translation>
        </message>
        <message>
            <source>phantom patient {seed}</source>
            <translation type="unfinished">patient fantôme {seed}</translation>
        </message>
        <message>
            <source>phantom slice {ready} of {slices}</source>
            <translation type="unfinished">coupe du fantôme {ready} sur {slices}</translation>
        </message>
        <message>
            <source>HighBit {high_bit} and BitsStored {bits_stored} leave the lowest {bits_below} bits of a pixel empty, and they are not; HighBit must be {right_high_bit}</source>
            <translation type="unfinished">HighBit {high_bit} et BitsStored {bits_stored} laissent vides des bits bas du pixel (nombre : {bits_below}), et ils ne le sont pas ; HighBit doit être {right_high_bit}</translation>
        </message>
        <message>
            <source>its compressed pixels are damaged</source>
            <translation type="unfinished">ses pixels compressés sont endommagés</translation>
        </message>
        <message>
            <source>{truncated}: its compressed pixels do not end</source>
            <translation type="unfinished">{truncated} : ses pixels compressés n’ont pas de fin</translation>
        </message>
        <message>
            <source>its compressed pixels are empty</source>
            <translation type="unfinished">ses pixels compressés sont vides</translation>
        </message>
        <message>
            <source>its {fragments} compressed fragments are not {frames} frames</source>
            <translation type="unfinished">ses fragments compressés ({fragments}) ne correspondent pas au nombre d’images ({frames})</translation>
        </message>
        <message>
            <source>it ends within its compressed pixels; read it again</source>
            <translation type="unfinished">il se termine au milieu de ses pixels compressés ; relisez-le</translation>
        </message>
        <message>
            <source>no decoder for transfer syntax {named}</source>
            <translation type="unfinished">pas de décodeur pour la syntaxe de transfert {named}</translation>
        </message>
        <message>
            <source>its pixels are of undefined length, as only compressed ones may be (PS3.5 A.4), and its transfer syntax is {raw_names}; have it sent again</source>
            <translation type="unfinished">ses pixels sont de longueur indéfinie, ce qui n’est permis qu’aux pixels compressés (PS3.5 A.4), et sa syntaxe de transfert est {raw_names} ; faites-le renvoyer</translation>
        </message>
        <message>
            <source>(what stands there is no UID)</source>
            <translation type="unfinished">(ce qui s’y trouve n’est pas un UID)</translation>
        </message>
        <message>
            <source>{truncated}: {{size}} bytes and no pixels in them</source>
            <translation type="unfinished">{truncated} : {{size}} octets et aucun pixel dedans</translation>
        </message>
        <message>
            <source>no pixels in it (PixelData is missing)</source>
            <translation type="unfinished">aucun pixel dedans (PixelData manque)</translation>
        </message>
        <message>
            <source>its pixels are compressed, and its transfer syntax is {raw_names}</source>
            <translation type="unfinished">ses pixels sont compressés, et sa syntaxe de transfert est {raw_names}</translation>
        </message>
        <message>
            <source>{contradiction}; have it sent again</source>
            <translation type="unfinished">{contradiction} ; faites-le renvoyer</translation>
        </message>
        <message>
            <source>{truncated}: the last {missing} bytes of pixels are missing</source>
            <translation type="unfinished">{truncated} : les {missing} derniers octets de pixels manquent</translation>
        </message>
        <message>
            <source>{length} bytes of pixels where {needed} are needed</source>
            <translation type="unfinished">{length} octets de pixels, il en faut {needed}</translation>
        </message>
        <message>
            <source>{length} bytes of pixels where {needed} are needed, {times} times as many: NumberOfFrames or BitsAllocated is not what it should be</source>
            <translation type="unfinished">{length} octets de pixels, il en faut {needed}, soit {times} fois plus : NumberOfFrames ou BitsAllocated n’est pas ce qu’il devrait être</translation>
        </message>
        <message>
            <source>its {length} bytes of pixels are not compressed, and its transfer syntax is {named}; have it sent again</source>
            <translation type="unfinished">ses {length} octets de pixels ne sont pas compressés, et sa syntaxe de transfert est {named} ; faites-le renvoyer</translation>
        </message>
        <message>
            <source>its sequences are nested deeper than {deepest} levels</source>
            <translation type="unfinished">ses séquences sont imbriquées sur plus de {deepest} niveaux</translation>
        </message>
        <message>
            <source>picture {picture}: pictures are counted from 1</source>
            <translation type="unfinished">image {picture} : les images sont comptées à partir de 1</translation>
        </message>
        <message>
            <source>box {column},{row},{columns},{rows}: column and row must be 0 or more, width and height 1 or more</source>
            <translation type="unfinished">cadre {column},{row},{columns},{rows} : la colonne et la ligne doivent être supérieures ou égales à 0, la largeur et la hauteur à 1</translation>
        </message>
        <message>
            <source>there is no picture {box_picture}: the series has {count}</source>
            <translation type="unfinished">il n’y a pas d’image {box_picture} : images dans la série : {count}</translation>
        </message>
        <message>
            <source>it is a secondary capture: such pictures often carry a name</source>
            <translation type="unfinished">c’est une capture secondaire : de telles images portent souvent un nom</translation>
        </message>
        <message>
            <source>it is a picture of a screen (ImageType {first})</source>
            <translation type="unfinished">c’est une image d’écran (ImageType {first})</translation>
        </message>
        <message>
            <source>it was converted from a film, a video or paper (ConversionType)</source>
            <translation type="unfinished">elle a été convertie d’un film, d’une vidéo ou d’un papier (ConversionType)</translation>
        </message>
        <message>
            <source>its series is described as pictures of a screen or a dose report</source>
            <translation type="unfinished">sa série est décrite comme des images d’écran ou un rapport de dose</translation>
        </message>
        <message>
            <source>its pictures carry writing (BurnedInAnnotation YES), which may be a name; draw boxes over the writing (--mask COL,ROW,WIDTH,HEIGHT) or choose another series</source>
            <translation type="unfinished">ses images portent du texte (BurnedInAnnotation YES), qui peut être un nom ; tracez des cadres sur le texte (--mask COL,ROW,WIDTH,HEIGHT) ou choisissez une autre série</translation>
        </message>
        <message>
            <source>box at column {box_column}, row {box_row} lies outside the picture of {columns} × {rows} pixels</source>
            <translation type="unfinished">le cadre en colonne {box_column}, ligne {box_row} est hors de l’image de {columns} × {rows} pixels</translation>
        </message>
        <message>
            <source>{path_name}: the preamble is not empty</source>
            <translation type="unfinished">{path_name} : le préambule n’est pas vide</translation>
        </message>
        <message>
            <source>{path_name}: its pixels are not those that were read</source>
            <translation type="unfinished">{path_name} : ses pixels ne sont pas ceux qui ont été lus</translation>
        </message>
        <message>
            <source>{path_name}: a text of the original header stands in it</source>
            <translation type="unfinished">{path_name} : un texte de l’en-tête d’origine s’y trouve</translation>
        </message>
        <message>
            <source>{path_name}: a name or number of the patient stands in its pixels</source>
            <translation type="unfinished">{path_name} : un nom ou un numéro du patient se trouve dans ses pixels</translation>
        </message>
        <message>
            <source>{path_name}: {name} should have been removed</source>
            <translation type="unfinished">{path_name} : {name} aurait dû être retiré</translation>
        </message>
        <message>
            <source>{path_name}: {name} still has its old UID</source>
            <translation type="unfinished">{path_name} : {name} a encore son ancien UID</translation>
        </message>
        <message>
            <source>{path_name}: {name} repeats what the original said elsewhere</source>
            <translation type="unfinished">{path_name} : {name} répète ce que l’original disait ailleurs</translation>
        </message>
        <message>
            <source>a face may be recognisable in the 3D view (body part {part}): nothing was removed from the pictures; keep this CT where patients' pictures may be kept</source>
            <translation type="unfinished">un visage peut être reconnaissable dans la vue 3D (région {part}) : rien n’a été retiré des images ; gardez ce CT là où les images de patients peuvent être gardées</translation>
        </message>
        <message>
            <source>the files' own texts speak of a head or neck: a face may be recognisable in the 3D view; nothing was removed from the pictures</source>
            <translation type="unfinished">les textes des fichiers parlent d’une tête ou d’un cou : un visage peut être reconnaissable dans la vue 3D ; rien n’a été retiré des images</translation>
        </message>
        <message>
            <source>the files do not say which body part they show: if it is the head, a face may be recognisable in the 3D view</source>
            <translation type="unfinished">les fichiers ne disent pas quelle région du corps ils montrent : si c’est la tête, un visage peut être reconnaissable dans la vue 3D</translation>
        </message>
        <message>
            <source>it cannot be read: {error_strerror}</source>
            <translation type="unfinished">il ne peut pas être lu : {error_strerror}</translation>
        </message>
        <message>
            <source>it cannot be read ({error_name})</source>
            <translation type="unfinished">il ne peut pas être lu ({error_name})</translation>
        </message>
        <message>
            <source>it has changed since the folder was looked at</source>
            <translation type="unfinished">il a changé depuis l’examen du dossier</translation>
        </message>
        <message>
            <source>boxes can be drawn on files of one picture only</source>
            <translation type="unfinished">des cadres ne peuvent être tracés que sur des fichiers d’une seule image</translation>
        </message>
        <message>
            <source>it cannot be written anew ({error_name})</source>
            <translation type="unfinished">il ne peut pas être réécrit ({error_name})</translation>
        </message>
        <message>
            <source>file 1 of {count}</source>
            <translation type="unfinished">fichier 1 sur {count}</translation>
        </message>
        <message>
            <source>file {current} of {count}</source>
            <translation type="unfinished">fichier {current} sur {count}</translation>
        </message>
        <message>
            <source>checking file {current} of {count}</source>
            <translation type="unfinished">vérification du fichier {current} sur {count}</translation>
        </message>
        <message>
            <source>file {file_number} of {count}: {error}</source>
            <translation type="unfinished">fichier {file_number} sur {count} : {error}</translation>
        </message>
        <message>
            <source>the privacy key {path} cannot be read or made: {error_strerror}; pseudonyms need it: make the folder writable</source>
            <translation type="unfinished">la clé de confidentialité {path} ne peut être ni lue ni créée : {error_strerror} ; les pseudonymes en ont besoin : rendez le dossier accessible en écriture</translation>
        </message>
        <message>
            <source>the privacy key {path} has {stored_bytes} bytes, {needed_bytes} are needed; put the kept copy back, or delete it: then every patient gets a new pseudonym</source>
            <translation type="unfinished">la clé de confidentialité {path} a {stored_bytes} octets, il en faut {needed_bytes} ; remettez la copie gardée, ou supprimez-la : chaque patient reçoit alors un nouveau pseudonyme</translation>
        </message>
        <message>
            <source>{count} pictures read</source>
            <translation type="unfinished">images lues : {count}</translation>
        </message>
        <message>
            <source>its pixels cannot be parted from what else stands with them</source>
            <translation type="unfinished">ses pixels ne peuvent pas être séparés de ce qui se trouve avec eux</translation>
        </message>
        <message>
            <source>{path}: {tag}: no action {action!r}</source>
            <translation type="unfinished">{path} : {tag} : pas d’action {action!r}</translation>
        </message>
        <message>
            <source>{path}: {keyword}: {form}: no such keyword or form</source>
            <translation type="unfinished">{path} : {keyword} : {form} : ce mot-clé ou cette forme n’existe pas</translation>
        </message>
        <message>
            <source>removed, because the value had another form</source>
            <translation type="unfinished">retirés, car la valeur avait une autre forme</translation>
        </message>
        <message>
            <source>private attributes removed: {private}</source>
            <translation type="unfinished">attributs privés retirés : {private}</translation>
        </message>
        <message>
            <source>pixels blackened in {masked} files</source>
            <translation type="unfinished">fichiers aux pixels noircis : {masked}</translation>
        </message>
        <message>
            <source>left out of the pixel data of {stripped} files: what is not pixels (comments, unused bits, bytes behind the last one)</source>
            <translation type="unfinished">retiré des données de pixels ce qui n’est pas des pixels (commentaires, bits inutilisés, octets après le dernier) ; fichiers concernés : {stripped}</translation>
        </message>
        <message>
            <source>pixel ({column}, {row}) is outside {header_path_name}: columns 0 to {form_columns}, rows 0 to {form_rows}</source>
            <translation type="unfinished">le pixel ({column}, {row}) est hors de {header_path_name} : colonnes 0 à {form_columns}, lignes 0 à {form_rows}</translation>
        </message>
        <message>
            <source>{header_path}: {header_damage}</source>
            <translation type="unfinished">{header_path} : {header_damage}</translation>
        </message>
        <message>
            <source>{header_path_name} is no CT image with position, orientation, spacing and rescale; choose a file that is</source>
            <translation type="unfinished">{header_path_name} n’est pas une image CT avec position, orientation, espacement et remise à l’échelle ; choisissez un fichier qui en est une</translation>
        </message>
        <message>
            <source>no file with SOPInstanceUID {sop_uid}{which} in {listing_path}</source>
            <translation type="unfinished">aucun fichier avec SOPInstanceUID {sop_uid}{which} dans {listing_path}</translation>
        </message>
        <message>
            <source>{listing_path} holds {usable} usable CT series; name one: {uids}</source>
            <translation type="unfinished">séries CT utilisables dans {listing_path} : {usable} ; nommez-en une : {uids}</translation>
        </message>
        <message>
            <source>{label}: {reason}{offer}</source>
            <translation type="unfinished">{label} : {reason}{offer}</translation>
        </message>
        <message>
            <source>no usable CT series in {listing_path}. {reasons}</source>
            <translation type="unfinished">aucune série CT utilisable dans {listing_path}. {reasons}</translation>
        </message>
        <message>
            <source>{listing_path} is empty; name a folder with DICOM files</source>
            <translation type="unfinished">{listing_path} est vide ; nommez un dossier contenant des fichiers DICOM</translation>
        </message>
        <message>
            <source>no DICOM series in {listing_path}: {ignored} {files} ignored ({first_path_name}: {first_reason})</source>
            <translation type="unfinished">aucune série DICOM dans {listing_path} : ignorés : {ignored} {files} ({first_path_name} : {first_reason})</translation>
        </message>
        <message>
            <source>no series {series_uid} in {listing_path}; it holds {valid}</source>
            <translation type="unfinished">pas de série {series_uid} dans {listing_path} ; présentes : {valid}</translation>
        </message>
        <message>
            <source>series {series_uid} holds {count} passes over the same places; name one: {parts}</source>
            <translation type="unfinished">la série {series_uid} contient {count} passages aux mêmes endroits ; nommez-en un : {parts}</translation>
        </message>
        <message>
            <source>series {series_key} cannot be used: {series_reason}{offer}</source>
            <translation type="unfinished">la série {series_key} ne peut pas être utilisée : {series_reason}{offer}</translation>
        </message>
        <message>
            <source>ask to {remedy} (--remedy {remedy})</source>
            <translation type="unfinished">avec le remède {remedy} (--remedy {remedy})</translation>
        </message>
        <message>
            <source>; it can be read if you {ways}</source>
            <translation type="unfinished">; elle peut être lue {ways}</translation>
        </message>
        <message>
            <source>the remedy {remedy!r} does not help series {series_key}: {reason}{instead}</source>
            <translation type="unfinished">le remède {remedy!r} n’aide pas la série {series_key} : {reason}{instead}</translation>
        </message>
        <message>
            <source>; read it as it is (--remedy {no_remedy})</source>
            <translation type="unfinished">; lisez-la telle quelle (--remedy {no_remedy})</translation>
        </message>
        <message>
            <source>; no remedy does</source>
            <translation type="unfinished">; aucun remède n’aide</translation>
        </message>
        <message>
            <source>values beyond 16 bits: reading as float32</source>
            <translation type="unfinished">valeurs au-delà de 16 bits : lecture en float32</translation>
        </message>
        <message>
            <source>has values beyond 16 bits and {too_large}</source>
            <translation type="unfinished">a des valeurs au-delà de 16 bits et {too_large}</translation>
        </message>
        <message>
            <source>; ask to {known_remedy} it</source>
            <translation type="unfinished">; utilisez le remède {known_remedy}</translation>
        </message>
        <message>
            <source>series {series_key} {reason}{ask}</source>
            <translation type="unfinished">la série {series_key} {reason}{ask}</translation>
        </message>
        <message>
            <source>slice {current} of {count}</source>
            <translation type="unfinished">coupe {current} sur {count}</translation>
        </message>
        <message>
            <source>{count} slices read, {i} × {j} × {k} voxels taken together</source>
            <translation type="unfinished">coupes lues : {count}, voxels regroupés par {i} × {j} × {k}</translation>
        </message>
        <message>
            <source>right {right} and down {down} are not perpendicular unit vectors</source>
            <translation type="unfinished">right {right} et down {down} ne sont pas des vecteurs unitaires perpendiculaires</translation>
        </message>
        <message>
            <source>right {across} and down {below} are parallel</source>
            <translation type="unfinished">right {across} et down {below} sont parallèles</translation>
        </message>
        <message>
            <source>{declared_path}: {no_remedy!r} means that a series is read as it is; rename the file</source>
            <translation type="unfinished">{declared_path} : {no_remedy!r} signifie qu’une série est lue telle quelle ; renommez le fichier</translation>
        </message>
        <message>
            <source>series {series_key} and what would be made of it need {both:.1f} GB of memory; close other programs or read a shorter series</source>
            <translation type="unfinished">la série {series_key} et ce qui en serait fait demandent {both:.1f} Go de mémoire ; fermez d’autres programmes ou lisez une série plus courte</translation>
        </message>
        <message>
            <source>slice {current} of {count} resampled</source>
            <translation type="unfinished">coupe {current} sur {count} rééchantillonnée</translation>
        </message>
        <message>
            <source>slices {step:g} mm apart cannot be made; ask for {finest_mm:g} to {coarsest_mm:g} mm</source>
            <translation type="unfinished">des coupes espacées de {step:g} mm ne peuvent pas être faites ; demandez {finest_mm:g} à {coarsest_mm:g} mm</translation>
        </message>
        <message>
            <source>{series_slices_path} says nothing of its place</source>
            <translation type="unfinished">{series_slices_path} ne dit rien de sa position</translation>
        </message>
        <message>
            <source>straightened from a gantry tilt of {grid_tilt_deg:.1f}°</source>
            <translation type="unfinished">redressé d’une inclinaison du statif de {grid_tilt_deg:.1f}°</translation>
        </message>
        <message>
            <source>resampled from slices {narrowest_mm:.3g} to {widest_mm:.3g} mm apart to {step:.3g} mm</source>
            <translation type="unfinished">rééchantillonné à partir de coupes espacées de {narrowest_mm:.3g} à {widest_mm:.3g} mm, à {step:.3g} mm</translation>
        </message>
        <message>
            <source>{empty} {gaps} of missing slices left empty</source>
            <translation type="unfinished">coupes manquantes laissées vides : {empty} {gaps}</translation>
        </message>
        <message>
            <source>there is no volume to write to</source>
            <translation type="unfinished">il n’y a pas de volume où écrire</translation>
        </message>
        <message>
            <source>{header_path} gives no Hounsfield units</source>
            <translation type="unfinished">{header_path} ne donne pas d’unités Hounsfield</translation>
        </message>
        <message>
            <source>the table position {centre_mm} is not a number</source>
            <translation type="unfinished">la position de table {centre_mm} n’est pas un nombre</translation>
        </message>
        <message>
            <source>{slices} slices: a scan has {fewest} to {most}</source>
            <translation type="unfinished">coupes : {slices} ; un scan en a {fewest} à {most}</translation>
        </message>
        <message>
            <source>slices of {slice_mm:g} mm: {thinnest_mm:g} to {thickest_mm:g} mm are valid</source>
            <translation type="unfinished">coupes de {slice_mm:g} mm : sont valides {thinnest_mm:g} à {thickest_mm:g} mm</translation>
        </message>
        <message>
            <source>the needle's hub and tip are both at {tip_mm}</source>
            <translation type="unfinished">l’embase et la pointe de l’aiguille sont toutes deux en {tip_mm}</translation>
        </message>
        <message>
            <source>a needle of radius {radius_mm} mm cannot be drawn</source>
            <translation type="unfinished">une aiguille de rayon {radius_mm} mm ne peut pas être dessinée</translation>
        </message>
        <message>
            <source>direction cosines not of length one: taken as they are written</source>
            <translation type="unfinished">cosinus directeurs de longueur différente de un : pris tels qu’ils sont écrits</translation>
        </message>
        <message>
            <source>{files} bytes behind the pixels, which are left out</source>
            <translation type="unfinished">octets après les pixels, laissés de côté ({files})</translation>
        </message>
        <message>
            <source>slices lie {between:.1f} mm apart and are {thickness:.3g} mm thick: what is shown between them is interpolated, nothing there was scanned</source>
            <translation type="unfinished">les coupes sont espacées de {between:.1f} mm et épaisses de {thickness:.3g} mm : ce qui est montré entre elles est interpolé, rien n’y a été scanné</translation>
        </message>
        <message>
            <source>not CT (modality {others})</source>
            <translation type="unfinished">pas un CT (modalité {others})</translation>
        </message>
        <message>
            <source>no photometric interpretation</source>
            <translation type="unfinished">pas de PhotometricInterpretation</translation>
        </message>
        <message>
            <source>not a CT image but a picture ({photometric}, secondary capture)</source>
            <translation type="unfinished">pas une image CT mais une autre image ({photometric}, capture secondaire)</translation>
        </message>
        <message>
            <source>secondary capture, not an original CT image</source>
            <translation type="unfinished">capture secondaire, pas une image CT originale</translation>
        </message>
        <message>
            <source>localizer (scout view), not a volume</source>
            <translation type="unfinished">image de repérage (localizer, scout), pas un volume</translation>
        </message>
        <message>
            <source>multi-frame file ({frames} frames) that does not say where each of them lies</source>
            <translation type="unfinished">fichier multi-images ({frames} images) qui ne dit pas où se trouve chacune</translation>
        </message>
        <message>
            <source>not CT but MR, and not an MR image</source>
            <translation type="unfinished">pas un CT mais une IRM, et pas une image IRM</translation>
        </message>
        <message>
            <source>not a CT image</source>
            <translation type="unfinished">pas une image CT</translation>
        </message>
        <message>
            <source>a mosaic: many slices side by side in one picture, which says of none where it lies</source>
            <translation type="unfinished">une mosaïque : beaucoup de coupes côte à côte dans une image, qui ne dit d’aucune où elle se trouve</translation>
        </message>
        <message>
            <source>{display_name} is {cut_first_damage}{more}; have it sent again</source>
            <translation type="unfinished">{display_name} : {cut_first_damage}{more} ; faites-le renvoyer</translation>
        </message>
        <message>
            <source>{form_bits_allocated} bits per pixel are not supported (8 or 16 are)</source>
            <translation type="unfinished">bits par pixel : {form_bits_allocated} ; 8 et 16 sont pris en charge</translation>
        </message>
        <message>
            <source>BitsStored {form_bits_stored}, HighBit {form_high_bit} and BitsAllocated {form_bits_allocated} contradict each other</source>
            <translation type="unfinished">BitsStored {form_bits_stored}, HighBit {form_high_bit} et BitsAllocated {form_bits_allocated} se contredisent</translation>
        </message>
        <message>
            <source>no pixels: {form_columns} columns × {form_rows} rows</source>
            <translation type="unfinished">pas de pixels : {form_columns} colonnes × {form_rows} lignes</translation>
        </message>
        <message>
            <source>no Hounsfield units (RescaleSlope and RescaleIntercept missing, or another unit)</source>
            <translation type="unfinished">pas d’unités Hounsfield (RescaleSlope et RescaleIntercept manquent, ou autre unité)</translation>
        </message>
        <message>
            <source>ImagePositionPatient, ImageOrientationPatient or PixelSpacing missing</source>
            <translation type="unfinished">ImagePositionPatient, ImageOrientationPatient ou PixelSpacing manque</translation>
        </message>
        <message>
            <source>mixed image sizes: </source>
            <translation type="unfinished">tailles d’image mélangées : </translation>
        </message>
        <message>
            <source>a single slice; a volume needs at least two</source>
            <translation type="unfinished">une seule coupe ; un volume en demande au moins deux</translation>
        </message>
        <message>
            <source>{count} series</source>
            <translation type="unfinished">séries : {count}</translation>
        </message>
        <message>
            <source>some of its files name no frame of reference: they lie together only if whoever wrote them left it out</source>
            <translation type="unfinished">certains de ses fichiers ne nomment pas de repère spatial (FrameOfReference) : ils ne vont ensemble que si celui qui les a écrits l’a omis</translation>
        </message>
        <message>
            <source>its files name {frames} frames of reference: they lie together only if whoever de-identified them gave each a number of its own</source>
            <translation type="unfinished">ses fichiers nomment {frames} repères spatiaux (FrameOfReference) : ils ne vont ensemble que si celui qui les a dé-identifiés a donné à chacun le sien</translation>
        </message>
        <message>
            <source>a picture of {values_shape} values on {place} px cannot be drawn</source>
            <translation type="unfinished">une image de {values_shape} valeurs sur {place} px ne peut pas être dessinée</translation>
        </message>
        <message>
            <source>skin found</source>
            <translation type="unfinished">peau trouvée</translation>
        </message>
        <message>
            <source>a slab of {thickness_mm} mm cannot be shown; it must be above 0 and at most {thickest_mm:g} mm</source>
            <translation type="unfinished">une coupe épaisse de {thickness_mm} mm ne peut pas être affichée ; il faut plus de 0 et au plus {thickest_mm:g} mm</translation>
        </message>
        <message>
            <source>files of two patients: {name} differs under one PatientID and StudyInstanceUID; put the files of each patient into a folder of their own</source>
            <translation type="unfinished">fichiers de deux patients : {name} diffère sous un même PatientID et StudyInstanceUID ; mettez les fichiers de chaque patient dans un dossier à part</translation>
        </message>
        <message>
            <source>set aside, as {role}: {names}{more}</source>
            <translation type="unfinished">mis de côté ({role}) : {names}{more}</translation>
        </message>
        <message>
            <source>of another direction than the slices</source>
            <translation type="unfinished">autre direction que les coupes</translation>
        </message>
        <message>
            <source>of another size than the slices</source>
            <translation type="unfinished">autre taille que les coupes</translation>
        </message>
        <message>
            <source>of another pixel spacing than the slices</source>
            <translation type="unfinished">autre espacement des pixels que les coupes</translation>
        </message>
        <message>
            <source>it is damaged ({error_name})</source>
            <translation type="unfinished">il est endommagé ({error_name})</translation>
        </message>
        <message>
            <source>it holds {files} files; {bounds_files} are unpacked at most</source>
            <translation type="unfinished">fichiers dans l’archive : {files} ; {bounds_files} au plus sont décompressés</translation>
        </message>
        <message>
            <source>it would grow {growth:.0f} times to {unpacked_gb:.1f} GB: no archive of pictures does that; unpack it yourself if you trust it</source>
            <translation type="unfinished">elle grossirait {growth:.0f} fois, jusqu’à {unpacked_gb:.1f} Go : aucune archive d’images ne fait cela ; décompressez-la vous-même si vous lui faites confiance</translation>
        </message>
        <message>
            <source>it unpacks to {unpacked_gb:.1f} GB and {free_gb:.1f} GB are free in the temporary folder; make room, or unpack it elsewhere and open that folder</source>
            <translation type="unfinished">elle fait {unpacked_gb:.1f} Go une fois décompressée, et {free_gb:.1f} Go sont libres dans le dossier temporaire ; faites de la place, ou décompressez-la ailleurs et ouvrez ce dossier</translation>
        </message>
        <message>
            <source>unpacking {current} of {count}</source>
            <translation type="unfinished">décompression : {current} sur {count}</translation>
        </message>
        <message>
            <source>leads out of the archive</source>
            <translation type="unfinished">mène hors de l’archive</translation>
        </message>
        <message>
            <source>has a name that is no file's</source>
            <translation type="unfinished">a un nom qui n’est pas celui d’un fichier</translation>
        </message>
        <message>
            <source>a link, not a file</source>
            <translation type="unfinished">un lien, pas un fichier</translation>
        </message>
        <message>
            <source>encrypted; unpack the archive yourself</source>
            <translation type="unfinished">chiffré ; décompressez l’archive vous-même</translation>
        </message>
        <message>
            <source>packed in a way that is not read (stored and deflated are)</source>
            <translation type="unfinished">compressé d’une façon qui n’est pas lue (seulement « stored » et « deflated »)</translation>
        </message>
        <message>
            <source>it holds {records} records</source>
            <translation type="unfinished">il contient {records} entrées</translation>
        </message>
        <message>
            <source>{path} cannot be unpacked: {error_strerror}</source>
            <translation type="unfinished">impossible de décompresser {path} : {error_strerror}</translation>
        </message>
        <message>
            <source>{path} cannot be unpacked: {reason}</source>
            <translation type="unfinished">impossible de décompresser {path} : {reason}</translation>
        </message>
        <message>
            <source>{path} cannot be read: {reason}</source>
            <translation type="unfinished">impossible de lire {path} : {reason}</translation>
        </message>
        <message>
            <source>{path} is a file, and no DICOM, DICOMDIR, NIfTI or zip file; name the folder it is in</source>
            <translation type="unfinished">{path} est un fichier, mais pas un fichier DICOM, DICOMDIR, NIfTI ou zip ; nommez le dossier où il se trouve</translation>
        </message>
        <message>
            <source>{root} does not exist; name a folder with DICOM files</source>
            <translation type="unfinished">{root} n’existe pas ; nommez un dossier contenant des fichiers DICOM</translation>
        </message>
        <message>
            <source>{root} is no folder; name one with DICOM files</source>
            <translation type="unfinished">{root} n’est pas un dossier ; nommez-en un contenant des fichiers DICOM</translation>
        </message>
        <message>
            <source>{root} cannot be read: {reason}</source>
            <translation type="unfinished">impossible de lire {root} : {reason}</translation>
        </message>
        <message>
            <source>{count} files found</source>
            <translation type="unfinished">fichiers trouvés : {count}</translation>
        </message>
        <message>
            <source>{path} cannot be read as a DICOMDIR ({error}); open its folder instead</source>
            <translation type="unfinished">{path} ne peut pas être lu comme DICOMDIR ({error}) ; ouvrez plutôt son dossier</translation>
        </message>
        <message>
            <source>mixed orientations: {first_orientation} and {plane_orientation}</source>
            <translation type="unfinished">orientations mélangées : {first_orientation} et {plane_orientation}</translation>
        </message>
        <message>
            <source>mixed pixel spacings: {first_pixel_spacing_mm} and {plane_pixel_spacing_mm} mm</source>
            <translation type="unfinished">espacements de pixels mélangés : {first_pixel_spacing_mm} et {plane_pixel_spacing_mm} mm</translation>
        </message>
        <message>
            <source>doubled slices: {lower_slice} and {upper_slice} lie at the same position and differ{more}</source>
            <translation type="unfinished">coupes en double : {lower_slice} et {upper_slice} sont à la même position et diffèrent{more}</translation>
        </message>
        <message>
            <source>slices turned against each other: the corners of {names} lie {slices_turned_mm:.3f} mm off (limit {tolerance_mm:g} mm)</source>
            <translation type="unfinished">coupes tournées les unes par rapport aux autres : les coins de {names} sont décalés de {slices_turned_mm:.3f} mm (limite {tolerance_mm:g} mm)</translation>
        </message>
        <message>
            <source>gap: {times} {plural} missing between {slice_before} and {slice_after} ({gap:.3f} mm apart where {usual:.3f} mm is usual)</source>
            <translation type="unfinished">lacune : {times} {plural} absente(s) entre {slice_before} et {slice_after} (écart de {gap:.3f} mm, habituellement {usual:.3f} mm)</translation>
        </message>
        <message>
            <source>slices shifted sideways against each other: up to {largest_mm:.3f} mm off a straight stack at {names} (limit {tolerance_mm:g} mm)</source>
            <translation type="unfinished">coupes décalées de côté les unes par rapport aux autres : jusqu’à {largest_mm:.3f} mm d’un empilement droit en {names} (limite {tolerance_mm:g} mm)</translation>
        </message>
        <message>
            <source>uneven spacing: slices {narrowest_mm:.3f} to {widest_mm:.3f} mm apart, up to {largest_mm:.3f} mm off an even grid at {names} (limit {tolerance_mm:g} mm)</source>
            <translation type="unfinished">espacement irrégulier : coupes distantes de {narrowest_mm:.3f} à {widest_mm:.3f} mm, jusqu’à {largest_mm:.3f} mm d’une grille régulière en {names} (limite {tolerance_mm:g} mm)</translation>
        </message>
        <message>
            <source>this CT lacks what a DICOM segmentation has to repeat of it ({lacking}); write a .seg.nrrd instead</source>
            <translation type="unfinished">il manque à ce CT ce qu’une segmentation DICOM doit en répéter ({lacking}) ; écrivez plutôt un .seg.nrrd</translation>
        </message>
        <message>
            <source>file {file_number} of this CT is gone or damaged ({brief})</source>
            <translation type="unfinished">le fichier {file_number} de ce CT a disparu ou est endommagé ({brief})</translation>
        </message>
        <message>
            <source>distances of {name}</source>
            <translation type="unfinished">distances : {name}</translation>
        </message>
        <message>
            <source>no voxel has {low:g} to {high:g} HU: widen the threshold</source>
            <translation type="unfinished">aucun voxel n’a de {low:g} à {high:g} UH : élargissez le seuil</translation>
        </message>
        <message>
            <source>the point to grow from lies outside the CT</source>
            <translation type="unfinished">le point de départ de la croissance est hors du CT</translation>
        </message>
        <message>
            <source>the point has {own:.0f} HU, which is not from {low:g} to {high:g}: click inside the structure, or move the limits</source>
            <translation type="unfinished">le point a {own:.0f} UH, ce qui n’est pas entre {low:g} et {high:g} : cliquez dans la structure, ou déplacez les limites</translation>
        </message>
        <message>
            <source>{path_name}: {error}</source>
            <translation type="unfinished">{path_name} : {error}</translation>
        </message>
        <message>
            <source>structures placed</source>
            <translation type="unfinished">structures placées</translation>
        </message>
        <message>
            <source>{item_name} lies outside this CT</source>
            <translation type="unfinished">{item_name} est hors de ce CT</translation>
        </message>
        <message>
            <source>{path_name}: structures are written as .seg.nrrd (3D Slicer) or .dcm (DICOM SEG)</source>
            <translation type="unfinished">{path_name} : les structures s’écrivent en .seg.nrrd (3D Slicer) ou .dcm (DICOM SEG)</translation>
        </message>
        <message>
            <source>there are no structures to write</source>
            <translation type="unfinished">il n’y a pas de structures à écrire</translation>
        </message>
        <message>
            <source>this volume is not slice for slice that of DICOM files (it was resampled, or comes from another format); write a .seg.nrrd instead</source>
            <translation type="unfinished">ce volume n’est pas coupe pour coupe celui de fichiers DICOM (il a été rééchantillonné, ou vient d’un autre format) ; écrivez plutôt un .seg.nrrd</translation>
        </message>
        <message>
            <source>{path} cannot be written: {error_strerror}</source>
            <translation type="unfinished">impossible d’écrire {path} : {error_strerror}</translation>
        </message>
        <message>
            <source>{path_name} has sizes {image_shape}; three are read</source>
            <translation type="unfinished">{path_name} a les tailles {image_shape} ; on en lit trois</translation>
        </message>
        <message>
            <source>{path_name} cannot be read as NIfTI ({fault})</source>
            <translation type="unfinished">{path_name} ne peut pas être lu comme NIfTI ({fault})</translation>
        </message>
        <message>
            <source>{path_name} holds fractions; a label map holds whole numbers</source>
            <translation type="unfinished">{path_name} contient des nombres fractionnaires ; une carte d’étiquettes contient des entiers</translation>
        </message>
        <message>
            <source>{path_name} holds {labels} labels above 0; a label map holds 1 to {most_labels}</source>
            <translation type="unfinished">étiquettes au-dessus de 0 dans {path_name} : {labels} ; une carte d’étiquettes en contient 1 à {most_labels}</translation>
        </message>
        <message>
            <source>{path_name} is {format_name}, not NIfTI</source>
            <translation type="unfinished">{path_name} est du {format_name}, pas du NIfTI</translation>
        </message>
        <message>
            <source>{path_name} does not say where it lies (neither sform nor qform is set)</source>
            <translation type="unfinished">{path_name} ne dit pas où il se trouve (ni sform ni qform n’est défini)</translation>
        </message>
        <message>
            <source>{path_name} lies further away than {furthest_mm:g} mm</source>
            <translation type="unfinished">{path_name} se trouve à plus de {furthest_mm:g} mm</translation>
        </message>
        <message>
            <source>{path_name}: its axes span no volume</source>
            <translation type="unfinished">{path_name} : ses axes n’engendrent pas de volume</translation>
        </message>
        <message>
            <source>{path_name} is not a regular file</source>
            <translation type="unfinished">{path_name} n’est pas un fichier ordinaire</translation>
        </message>
        <message>
            <source>no file of structures</source>
            <translation type="unfinished">pas un fichier de structures</translation>
        </message>
        <message>
            <source>{path_name} cannot be read ({brief})</source>
            <translation type="unfinished">{path_name} ne peut pas être lu ({brief})</translation>
        </message>
        <message>
            <source>no structures</source>
            <translation type="unfinished">pas des structures</translation>
        </message>
        <message>
            <source>of an unknown SOP class</source>
            <translation type="unfinished">de classe SOP inconnue</translation>
        </message>
        <message>
            <source>{path_name} is {found_format}; DICOM SEG, RTSTRUCT, .seg.nrrd and NIfTI labels are read</source>
            <translation type="unfinished">{path_name} est {found_format} ; sont lus DICOM SEG, RTSTRUCT, .seg.nrrd et étiquettes NIfTI</translation>
        </message>
        <message>
            <source>structure {current} of {count}</source>
            <translation type="unfinished">structure {current} sur {count}</translation>
        </message>
        <message>
            <source>the structures in the file are empty: nothing is drawn in them</source>
            <translation type="unfinished">les structures du fichier sont vides : rien n’y est dessiné</translation>
        </message>
        <message>
            <source>none of the structures in the file lies in this CT: they belong to another patient or another scan</source>
            <translation type="unfinished">aucune des structures du fichier n’est dans ce CT : elles appartiennent à un autre patient ou à un autre scan</translation>
        </message>
        <message>
            <source>the file names no frame of reference: placed by its coordinates alone</source>
            <translation type="unfinished">le fichier ne nomme pas de repère spatial : placé d’après ses seules coordonnées</translation>
        </message>
        <message>
            <source>the file names another frame of reference (…{named}) than this CT (…{own}), but also this very series as the one that it was drawn on: placed by its coordinates; check that the outlines fit the picture</source>
            <translation type="unfinished">le fichier nomme un autre repère spatial (…{named}) que ce CT (…{own}), mais aussi cette même série comme celle sur laquelle il a été dessiné : placé d’après ses coordonnées ; vérifiez que les contours vont avec l’image</translation>
        </message>
        <message>
            <source>the structures were drawn on another frame of reference (…{named}) than that of this CT (…{own}), and the file does not name this series: open the CT that they belong to</source>
            <translation type="unfinished">les structures ont été dessinées dans un autre repère spatial (…{named}) que celui de ce CT (…{own}), et le fichier ne nomme pas cette série : ouvrez le CT auquel elles appartiennent</translation>
        </message>
        <message>
            <source>{labelled_name} is empty in the file and was left out</source>
            <translation type="unfinished">{labelled_name} est vide dans le fichier et a été laissé de côté</translation>
        </message>
        <message>
            <source>{labelled_name} lies outside this CT and was left out</source>
            <translation type="unfinished">{labelled_name} est hors de ce CT et a été laissé de côté</translation>
        </message>
        <message>
            <source>{outside:.0f} % of {name} lie outside this CT</source>
            <translation type="unfinished">{outside:.0f} % de {name} sont hors de ce CT</translation>
        </message>
        <message>
            <source>{name} has {here:.2f} ml on the grid of this CT, {there:.2f} ml in the file</source>
            <translation type="unfinished">{name} fait {here:.2f} ml sur la grille de ce CT, {there:.2f} ml dans le fichier</translation>
        </message>
        <message>
            <source>{name}: {count} {contours} {reason} left out</source>
            <translation type="unfinished">{name} : laissé de côté : {count} {contours} {reason}</translation>
        </message>
        <message>
            <source>its contours spread over {columns} × {rows} × {slices} voxels</source>
            <translation type="unfinished">ses contours s’étendent sur {columns} × {rows} × {slices} voxels</translation>
        </message>
        <message>
            <source>contour that is</source>
            <translation type="unfinished">contour</translation>
        </message>
        <message>
            <source>contours that are</source>
            <translation type="unfinished">contours</translation>
        </message>
        <message>
            <source>{repeated} {times} in the file twice counted once</source>
            <translation type="unfinished">doublons du fichier comptés une seule fois : {repeated} {times}</translation>
        </message>
        <message>
            <source>contours that cross one another were joined</source>
            <translation type="unfinished">les contours qui se croisent ont été réunis</translation>
        </message>
        <message>
            <source>{path_name} holds no closed contour that can be used{reason}</source>
            <translation type="unfinished">{path_name} ne contient aucun contour fermé utilisable{reason}</translation>
        </message>
        <message>
            <source>{path_name} is no whole RT Structure Set ({brief})</source>
            <translation type="unfinished">{path_name} n’est pas un RT Structure Set complet ({brief})</translation>
        </message>
        <message>
            <source>its SpacingBetweenSlices ({between:g} mm) contradicts its frames (at least {least_gap_mm:.3g} mm apart): each frame was placed where it says itself</source>
            <translation type="unfinished">son SpacingBetweenSlices ({between:g} mm) contredit ses images (distantes d’au moins {least_gap_mm:.3g} mm) : chaque image a été placée là où elle le dit elle-même</translation>
        </message>
        <message>
            <source>it spreads over </source>
            <translation type="unfinished">étendue : </translation>
        </message>
        <message>
            <source>{path_name} cannot be read as NRRD ({fault})</source>
            <translation type="unfinished">{path_name} ne peut pas être lu comme NRRD ({fault})</translation>
        </message>
        <message>
            <source>{path_name} holds {values_dtype} values; a label map holds whole numbers</source>
            <translation type="unfinished">{path_name} contient des valeurs {values_dtype} ; une carte d’étiquettes contient des entiers</translation>
        </message>
        <message>
            <source>{path_name} keeps its data in other files; only attached data are read</source>
            <translation type="unfinished">{path_name} garde ses données dans d’autres fichiers ; seules les données incluses sont lues</translation>
        </message>
        <message>
            <source>{path_name} has sizes {sizes}; three of a label map, and layers, are read</source>
            <translation type="unfinished">{path_name} a les tailles {sizes} ; on lit les trois d’une carte d’étiquettes, plus des plans</translation>
        </message>
        <message>
            <source>{path_name} does not say where it lies: space {space!r}, {directions_shape} directions; left-posterior-superior or its like is needed</source>
            <translation type="unfinished">{path_name} ne dit pas où il se trouve : space {space!r}, directions {directions_shape} ; il faut left-posterior-superior ou un équivalent</translation>
        </message>
        <message>
            <source>{path_name} has {spatial} axes in space; 3 are needed</source>
            <translation type="unfinished">axes spatiaux dans {path_name} : {spatial} ; il en faut 3</translation>
        </message>
        <message>
            <source>{path_name} holds {labels} labels: not a label map</source>
            <translation type="unfinished">étiquettes dans {path_name} : {labels} ; ce n’est pas une carte d’étiquettes</translation>
        </message>
        <message>
            <source>{path_name}, segment {segment_number}: its layer or label is no whole number</source>
            <translation type="unfinished">{path_name}, segment {segment_number} : son plan ou son étiquette n’est pas un entier</translation>
        </message>
        <message>
            <source>{path_name}, segment {segment_number}: layer {layer} of {layers}</source>
            <translation type="unfinished">{path_name}, segment {segment_number} : plan {layer} sur {layers}</translation>
        </message>
        <message>
            <source>{path_name} is big endian; DICOM segmentations are read in little endian only</source>
            <translation type="unfinished">{path_name} est en big endian ; les segmentations DICOM ne sont lues qu’en little endian</translation>
        </message>
        <message>
            <source>{path_name} {error}</source>
            <translation type="unfinished">{path_name} {error}</translation>
        </message>
        <message>
            <source>{path_name} cannot be read as a DICOM segmentation ({brief})</source>
            <translation type="unfinished">{path_name} ne peut pas être lu comme segmentation DICOM ({brief})</translation>
        </message>
        <message>
            <source>has no SegmentationType that is read: {types}</source>
            <translation type="unfinished">n’a pas de SegmentationType qui soit lu : {types}</translation>
        </message>
        <message>
            <source>has {dataset_bits_allocated} bits per pixel; 1, 8, 16 are read</source>
            <translation type="unfinished">a {dataset_bits_allocated} bits par pixel ; sont lus 1, 8, 16</translation>
        </message>
        <message>
            <source>holds no frame that says where it lies</source>
            <translation type="unfinished">ne contient aucune image qui dise où elle se trouve</translation>
        </message>
        <message>
            <source>holds no pixels that can be read: it is cut short or damaged</source>
            <translation type="unfinished">ne contient aucun pixel lisible : fichier tronqué ou endommagé</translation>
        </message>
        <message>
            <source>{name!r} is no name for a structure: 1 to {longest_name} characters are</source>
            <translation type="unfinished">{name!r} n’est pas un nom de structure : il faut 1 à {longest_name} caractères</translation>
        </message>
        <message>
            <source>warning distance {warn_mm:g} mm of {name}: 0 to 50 mm are</source>
            <translation type="unfinished">distance d’alerte {warn_mm:g} mm de {name} : il faut 0 à 50 mm</translation>
        </message>
        <message>
            <source>structure {name} holds no voxel of this CT</source>
            <translation type="unfinished">la structure {name} ne contient aucun voxel de ce CT</translation>
        </message>
        <message>
            <source>mask of {mask_shape} voxels on a CT of {volume_hu_shape}</source>
            <translation type="unfinished">masque de {mask_shape} voxels sur un CT de {volume_hu_shape}</translation>
        </message>
        <message>
            <source>a structure needs at least one voxel</source>
            <translation type="unfinished">une structure demande au moins un voxel</translation>
        </message>
        <message>
            <source>structure {double_name} is there twice: rename one</source>
            <translation type="unfinished">la structure {double_name} figure deux fois : renommez-en une</translation>
        </message>
        <message>
            <source>there is no structure {name!r}; there are: {names}</source>
            <translation type="unfinished">il n’y a pas de structure {name!r} ; il y a : {names}</translation>
        </message>
        <message>
            <source>series {series_key} has no slices to show</source>
            <translation type="unfinished">la série {series_key} n’a pas de coupes à montrer</translation>
        </message>
        <message>
            <source>the pixels of {header_path_name} are no grey picture</source>
            <translation type="unfinished">les pixels de {header_path_name} ne forment pas une image en niveaux de gris</translation>
        </message>
        <message>
            <source>{header_path_name} is {form_columns} × {form_rows} pixels</source>
            <translation type="unfinished">{header_path_name} fait {form_columns} × {form_rows} pixels</translation>
        </message>
        <message>
            <source>{name}{inside}, no Hounsfield units</source>
            <translation type="unfinished">{name}{inside}, pas d’unités Hounsfield</translation>
        </message>
        <message>
            <source>by ImageType these are Hounsfield units of one material only, not of the body</source>
            <translation type="unfinished">d’après ImageType, ce sont les unités Hounsfield d’un seul matériau, pas du corps</translation>
        </message>
        <message>
            <source>by ImageType values were changed to make a material stand out</source>
            <translation type="unfinished">d’après ImageType, des valeurs ont été modifiées pour faire ressortir un matériau</translation>
        </message>
        <message>
            <source>no Hounsfield units: RescaleType is {unit_name}, where HU is read</source>
            <translation type="unfinished">pas d’unités Hounsfield : RescaleType est {unit_name}, alors que HU est lu</translation>
        </message>
        <message>
            <source>no Hounsfield units that the file vouches for: MultienergyCTAcquisition is YES, and then RescaleType must say what the values are; it is missing</source>
            <translation type="unfinished">pas d’unités Hounsfield que le fichier garantisse : MultienergyCTAcquisition vaut YES, et RescaleType doit alors dire ce que sont les valeurs ; il manque</translation>
        </message>
        <message>
            <source>window width {width} / level {level} HU: the width must be {minimum_width:g} to {limit:g} and the level within ±{limit:g}</source>
            <translation type="unfinished">fenêtrage de largeur {width} / niveau {level} UH : la largeur doit aller de {minimum_width:g} à {limit:g} et le niveau être dans ±{limit:g}</translation>
        </message>
        <message>
            <source>it needs more than {size} MB of memory to be read</source>
            <translation type="unfinished">il demande plus de {size} Mo de mémoire à la lecture</translation>
        </message>
        <message>
            <source>it cannot be read ({kind})</source>
            <translation type="unfinished">il ne peut pas être lu ({kind})</translation>
        </message>
        <message>
            <source>talked nonsense</source>
            <translation type="unfinished">a répondu n’importe quoi</translation>
        </message>
        <message>
            <source>damaged or hostile file: the process that read it {reason}</source>
            <translation type="unfinished">fichier endommagé ou malveillant : le processus qui le lisait {reason}</translation>
        </message>
        <message>
            <source>the memory beside a message is of no use</source>
            <translation type="unfinished">la mémoire jointe à un message est inutilisable</translation>
        </message>
        <message>
            <source>an array beside a message lies outside its memory</source>
            <translation type="unfinished">un tableau joint à un message est hors de sa mémoire</translation>
        </message>
        <message>
            <source>an array beside a message is none</source>
            <translation type="unfinished">un tableau joint à un message n’en est pas un</translation>
        </message>
        <message>
            <source>a message of {length} bytes</source>
            <translation type="unfinished">un message de {length} octets</translation>
        </message>
        <message>
            <source>no file descriptor came</source>
            <translation type="unfinished">aucun descripteur de fichier n’est arrivé</translation>
        </message>
        <message>
            <source>{name} is no number</source>
            <translation type="unfinished">{name} n’est pas un nombre</translation>
        </message>
        <message>
            <source>the process that reads foreign files {lost}</source>
            <translation type="unfinished">le processus qui lit les fichiers étrangers {lost}</translation>
        </message>
        <message>
            <source>the process that reads foreign files {lost} before it was ready; its memory or its installation may fail: see `acus check`, or install the program again</source>
            <translation type="unfinished">le processus qui lit les fichiers étrangers {lost} avant d’être prêt ; sa mémoire ou son installation est peut-être en cause : voyez `acus check`, ou réinstallez le programme</translation>
        </message>
        <message>
            <source>: it gave itself up, out of memory or in a state that cannot be</source>
            <translation type="unfinished">: il a renoncé de lui-même, faute de mémoire ou dans un état impossible</translation>
        </message>
        <message>
            <source>: it crashed</source>
            <translation type="unfinished">: il a planté</translation>
        </message>
        <message>
            <source>: by the system when memory ran out, or by somebody</source>
            <translation type="unfinished">: par le système, faute de mémoire, ou par quelqu’un</translation>
        </message>
        <message>
            <source>: it computed for longer than any file may</source>
            <translation type="unfinished">: il a calculé plus longtemps qu’aucun fichier ne le peut</translation>
        </message>
        <message>
            <source>no answer</source>
            <translation type="unfinished">n’a pas répondu</translation>
        </message>
        <message>
            <source>talked nonsense ({error})</source>
            <translation type="unfinished">a répondu n’importe quoi ({error})</translation>
        </message>
        <message>
            <source>was not ready within {ready_seconds:.0f} s</source>
            <translation type="unfinished">n’était pas prêt au bout de {ready_seconds:.0f} s</translation>
        </message>
        <message>
            <source>took longer than {allowed_seconds:.1f} s of computing</source>
            <translation type="unfinished">a calculé plus de {allowed_seconds:.1f} s</translation>
        </message>
        <message>
            <source>waited longer than {allowed_clock_seconds:.0f} s for it</source>
            <translation type="unfinished">a attendu plus de {allowed_clock_seconds:.0f} s</translation>
        </message>
        <message>
            <source>closed its connection</source>
            <translation type="unfinished">a fermé sa connexion</translation>
        </message>
        <message>
            <source>ended with code {code}</source>
            <translation type="unfinished">s’est terminé avec le code {code}</translation>
        </message>
        <message>
            <source>was ended by {name}{reason}</source>
            <translation type="unfinished">a été arrêté par {name}{reason}</translation>
        </message>
        <message>
            <source>the process that reads foreign files cannot be started: {error_strerror}</source>
            <translation type="unfinished">le processus qui lit les fichiers étrangers ne peut pas être démarré : {error_strerror}</translation>
        </message>
        <message>
            <source>no sentence</source>
            <translation type="unfinished">pas une phrase</translation>
        </message>
        <message>
            <source>a template without its values</source>
            <translation type="unfinished">un modèle sans ses valeurs</translation>
        </message>
        <message>
            <source>a sentence without end</source>
            <translation type="unfinished">une phrase sans fin</translation>
        </message>
        <message>
            <source>a number without end</source>
            <translation type="unfinished">un nombre sans fin</translation>
        </message>
        <message>
            <source>no template</source>
            <translation type="unfinished">pas un modèle</translation>
        </message>
        <message>
            <source>a template that does more than name its values</source>
            <translation type="unfinished">un modèle qui fait plus que nommer ses valeurs</translation>
        </message>
        <message>
            <source>{ready} of {count} files</source>
            <translation type="unfinished">fichiers : {ready} sur {count}</translation>
        </message>
        <message>
            <source>{path}: {fault} (decoder {decoder}); leave it out</source>
            <translation type="unfinished">{path} : {fault} (décodeur {decoder}) ; laissez-le de côté</translation>
        </message>
        <message>
            <source>{path}: {fault}</source>
            <translation type="unfinished">{path} : {fault}</translation>
        </message>
        <message>
            <source>{where}: {msg}</source>
            <translation type="unfinished">{where} : {msg}</translation>
        </message>
        <message>
            <source>{type_name} where an array is wanted</source>
            <translation type="unfinished">{type_name} là où il faut un tableau</translation>
        </message>
        <message>
            <source>an array of {value_dtype}, not of {dtype}</source>
            <translation type="unfinished">un tableau de {value_dtype}, pas de {dtype}</translation>
        </message>
        <message>
            <source>geometry: {name} is {length} m; a positive length is needed</source>
            <translation type="unfinished">géométrie : {name} vaut {length} m ; il faut une longueur positive</translation>
        </message>
        <message>
            <source>geometry: the fulcrum stands at z = {fulcrum} m; it must be above the links (z &gt; 0)</source>
            <translation type="unfinished">géométrie : le point de pivot est à z = {fulcrum} m ; il doit être au-dessus des segments (z &gt; 0)</translation>
        </message>
        <message>
            <source>{name} has shape {array_shape}; (2,) is needed</source>
            <translation type="unfinished">{name} a la forme {array_shape} ; il faut (2,)</translation>
        </message>
        <message>
            <source>device {profile_name} is a {profile_kind}, no pantograph</source>
            <translation type="unfinished">l’appareil {profile_name} est un {profile_kind}, pas un pantographe</translation>
        </message>
        <message>
            <source>fulcrum stands at y = {y:g} m; it must be in front of the motors, y &gt; 0</source>
            <translation type="unfinished">fulcrum est à y = {y:g} m ; il doit être devant les moteurs, y &gt; 0</translation>
        </message>
        <message>
            <source>fulcrum stands over a point {away:.4g} m from the {name} motor axis; proximal and distal reach from {low:.4g} to {high:.4g} m</source>
            <translation type="unfinished">fulcrum est au-dessus d’un point à {away:.4g} m de l’axe du moteur ({name}) ; proximal et distal vont de {low:.4g} à {high:.4g} m</translation>
        </message>
        <message>
            <source>fulcrum ({x:g}, {y:g}) m lies behind the elbows; with elbows outwards the links meet on the far side of them (greater y)</source>
            <translation type="unfinished">fulcrum ({x:g}, {y:g}) m est derrière les coudes ; coudes vers l’extérieur, les segments se rejoignent de l’autre côté de ceux-ci (y plus grand)</translation>
        </message>
        <message>
            <source>needle_length {needle_length:g} m must be greater than the lever below the fulcrum, {height:g} m, or nothing is left above it to hold</source>
            <translation type="unfinished">needle_length {needle_length:g} m doit dépasser le levier sous le point de pivot, {height:g} m, sinon il ne reste rien à tenir au-dessus</translation>
        </message>
        <message>
            <source>workspace.tilt_limit_deg of joint {name!r} is {tilt:g}: there the tool would be {away:.3g} m from under the fulcrum, and the links reach {reach:.3g} m at most; give at most {degrees:.1f}</source>
            <translation type="unfinished">workspace.tilt_limit_deg de l’articulation {name!r} vaut {tilt:g} : l’outil y serait à {away:.3g} m du dessous du point de pivot, et les segments atteignent {reach:.3g} m au plus ; donnez au plus {degrees:.1f}</translation>
        </message>
        <message>
            <source>device {profile_name} is of kind {profile_kind}; this is about devices of kind pantograph alone</source>
            <translation type="unfinished">l’appareil {profile_name} est du type {profile_kind} ; ceci ne concerne que les appareils du type pantograph</translation>
        </message>
        <message>
            <source>no grip: L_out = {needle_l_out} m; a positive length is needed</source>
            <translation type="unfinished">pas de prise : L_out = {needle_l_out} m ; il faut une longueur positive</translation>
        </message>
        <message>
            <source>degenerate: the needle direction {needle_axis} does not point down through the plane of the links</source>
            <translation type="unfinished">dégénéré : la direction de l’aiguille {needle_axis} ne descend pas à travers le plan des segments</translation>
        </message>
        <message>
            <source>jacobian has shape {array_shape}; (2, 2) is needed</source>
            <translation type="unfinished">la jacobienne a la forme {array_shape} ; il faut (2, 2)</translation>
        </message>
        <message>
            <source>force has shape {array_shape}; (3,) is needed</source>
            <translation type="unfinished">la force a la forme {array_shape} ; il faut (3,)</translation>
        </message>
        <message>
            <source>P3 = {needle_p3} m: this working mode does not close there in assembly {assembly}, which puts P3 at {reached} m</source>
            <translation type="unfinished">P3 = {needle_p3} m : ce mode de travail ne s’y ferme pas dans l’assemblage {assembly}, qui place P3 en {reached} m</translation>
        </message>
        <message>
            <source>singular ({kind}): joint rates at P3 = {needle_p3} m</source>
            <translation type="unfinished">singulier ({kind}) : vitesses des articulations en P3 = {needle_p3} m</translation>
        </message>
        <message>
            <source>no grip: L_out = {outside} m at L_in = {l_in} m; the needle of {length} m must stand out of the fulcrum (L_out &gt; 0)</source>
            <translation type="unfinished">pas de prise : L_out = {outside} m pour L_in = {l_in} m ; l’aiguille de {length} m doit dépasser du point de pivot (L_out &gt; 0)</translation>
        </message>
        <message>
            <source>l_out = {l_out} m does not fit mode {mode!r}: mode 'measured' needs l_out, mode 'printed' computes it</source>
            <translation type="unfinished">l_out = {l_out} m ne va pas avec le mode {mode!r} : le mode « measured » demande l_out, le mode « printed » le calcule</translation>
        </message>
        <message>
            <source>hub has shape {point_shape}; (3,) is needed</source>
            <translation type="unfinished">l’embase a la forme {point_shape} ; il faut (3,)</translation>
        </message>
        <message>
            <source>workspace.depth_max {deepest:g} m must be below geometry.needle_length {length:g} m: the hub stays outside the fulcrum</source>
            <translation type="unfinished">workspace.depth_max {deepest:g} m doit être inférieur à geometry.needle_length {length:g} m : l’embase reste hors du point de pivot</translation>
        </message>
        <message>
            <source>inertia.needle_centre {inertia_needle_centre:g} m must lie on the needle of geometry.needle_length {length:g} m</source>
            <translation type="unfinished">inertia.needle_centre {inertia_needle_centre:g} m doit être sur l’aiguille de geometry.needle_length {length:g} m</translation>
        </message>
        <message>
            <source>device {name}: machine {kind!r} cannot be used: {fault}</source>
            <translation type="unfinished">appareil {name} : la machine {kind!r} ne peut pas être utilisée : {fault}</translation>
        </message>
        <message>
            <source>device {name}: no joint {joint!r}; valid names: {names}</source>
            <translation type="unfinished">appareil {name} : pas d’articulation {joint!r} ; noms valides : {names}</translation>
        </message>
        <message>
            <source>device {name}: a needle of {length:g} m; it holds needles longer than {least:g} m and shorter than {longest_needle:g} m</source>
            <translation type="unfinished">appareil {name} : une aiguille de {length:g} m ; il tient des aiguilles plus longues que {least:g} m et plus courtes que {longest_needle:g} m</translation>
        </message>
        <message>
            <source>{origin}: kind: there is no machine of kind {kind!r}; valid kinds: {kinds}</source>
            <translation type="unfinished">{origin} : kind : il n’y a pas de machine du type {kind!r} ; types valides : {kinds}</translation>
        </message>
        <message>
            <source>{origin}: machine {kind!r}: {module_file} has no PROFILE</source>
            <translation type="unfinished">{origin} : machine {kind!r} : {module_file} n’a pas de PROFILE</translation>
        </message>
        <message>
            <source>{origin}: machine {kind!r} cannot be used: {fault}</source>
            <translation type="unfinished">{origin} : la machine {kind!r} ne peut pas être utilisée : {fault}</translation>
        </message>
        <message>
            <source>no device profile {wanted!r}; valid names: {profile_names}, or the path of a .yaml file</source>
            <translation type="unfinished">il n’y a pas de profil d’appareil {wanted!r} ; noms valides : {profile_names}, ou le chemin d’un fichier .yaml</translation>
        </message>
        <message>
            <source>no provenance for {missing}</source>
            <translation type="unfinished">pas d’origine (provenance) pour {missing}</translation>
        </message>
        <message>
            <source>provenance of {unknown}, which the section does not have</source>
            <translation type="unfinished">origine (provenance) de {unknown}, que la section n’a pas</translation>
        </message>
        <message>
            <source>joint {joint!r} is not one of {tilt_limit_deg}</source>
            <translation type="unfinished">l’articulation {joint!r} n’est aucune de {tilt_limit_deg}</translation>
        </message>
        <message>
            <source>depth_min {least_depth} must be below depth_max {largest_depth}</source>
            <translation type="unfinished">depth_min {least_depth} doit être inférieur à depth_max {largest_depth}</translation>
        </message>
        <message>
            <source>no joint angles point the needle along {axis} ({branches})</source>
            <translation type="unfinished">aucun angle des articulations n’oriente l’aiguille selon {axis} ({branches})</translation>
        </message>
        <message>
            <source>needle direction {direction} does not point down</source>
            <translation type="unfinished">la direction de l’aiguille {direction} ne descend pas</translation>
        </message>
        <message>
            <source>{status}: {cause}</source>
            <translation type="unfinished">{status} : {cause}</translation>
        </message>
        <message>
            <source>not finite: β = {b} rad, τ = {asked} N·m, stiffness {wanted}</source>
            <translation type="unfinished">non fini : β = {b} rad, τ = {asked} N·m, raideur {wanted}</translation>
        </message>
        <message>
            <source>stiffness is {wanted} N·m/rad; ask for more than 0, or for none</source>
            <translation type="unfinished">la raideur est {wanted} N·m/rad ; demandez plus de 0, ou aucune</translation>
        </message>
        <message>
            <source>degenerate: L_out = {l_out} m; a hub stands outside the centre</source>
            <translation type="unfinished">dégénéré : L_out = {l_out} m ; une embase se trouve hors du centre</translation>
        </message>
        <message>
            <source>singular: stiffness of the guide at β = {beta} rad</source>
            <translation type="unfinished">singulier : raideur du guide en β = {beta} rad</translation>
        </message>
        <message>
            <source>Jacobian has {entries} entries; 6 are needed</source>
            <translation type="unfinished">éléments de la jacobienne : {entries} ; il en faut 6</translation>
        </message>
        <message>
            <source>geometry: {name} is {degrees:.6g}°; a base joint stands within ±89° of its horizontal axis</source>
            <translation type="unfinished">géométrie : {name} vaut {degrees:.6g}° ; une articulation de base est à moins de ±89° de son axe horizontal</translation>
        </message>
        <message>
            <source>geometry: reading is {reading!r}; there are {joint_reading}</source>
            <translation type="unfinished">géométrie : reading vaut {reading!r} ; il y a {joint_reading}</translation>
        </message>
        <message>
            <source>geometry: the base joints lie {degrees:.3g}° apart as seen from the remote centre; they span no sphere within 2° of 0° or 180°: lower a tilt</source>
            <translation type="unfinished">géométrie : vues du centre de rotation, les articulations de base sont à {degrees:.3g}° l’une de l’autre ; à moins de 2° de 0° ou 180° elles n’engendrent pas de sphère : réduisez une inclinaison</translation>
        </message>
        <message>
            <source>geometry: the bars reach {first_reach_deg:.4g}° and {second_reach_deg:.4g}°, the base joints are {apart_deg:.4g}° apart: no pose closes both pantographs; lengthen f1 or f2</source>
            <translation type="unfinished">géométrie : les barres atteignent {first_reach_deg:.4g}° et {second_reach_deg:.4g}°, les articulations de base sont à {apart_deg:.4g}° l’une de l’autre : aucune pose ne ferme les deux pantographes ; allongez f1 ou f2</translation>
        </message>
        <message>
            <source>cables: {name} is {quantity}; give a number</source>
            <translation type="unfinished">câbles : {name} vaut {quantity} ; donnez un nombre</translation>
        </message>
        <message>
            <source>cables: stiffness {stiffness} N/m, stiffening {stiffening} 1/m; the first must be positive, the second 0 or more</source>
            <translation type="unfinished">câbles : raideur {stiffness} N/m, raidissement {stiffening} 1/m ; la première doit être positive, le second supérieur ou égal à 0</translation>
        </message>
        <message>
            <source>cables: tensions from {least} to {most} N; a cable pulls, so the least is 0 or more, and below the most</source>
            <translation type="unfinished">câbles : tensions de {least} à {most} N ; un câble tire, donc la plus petite est supérieure ou égale à 0, et inférieure à la plus grande</translation>
        </message>
        <message>
            <source>bars: {name} is {quantity}; a positive number is needed</source>
            <translation type="unfinished">barres : {name} vaut {quantity} ; il faut un nombre positif</translation>
        </message>
        <message>
            <source>masses: {name} is {mass}; a number from 0 on is needed</source>
            <translation type="unfinished">masses : {name} vaut {mass} ; il faut un nombre supérieur ou égal à 0</translation>
        </message>
        <message>
            <source>{name} has shape {array_shape}; ({count},) is needed</source>
            <translation type="unfinished">{name} a la forme {array_shape} ; il faut ({count},)</translation>
        </message>
        <message>
            <source>unreachable: direction t = ({x}, {y}, {z}); the nearest within reach is {near}, {away:.3g}° away</source>
            <translation type="unfinished">inatteignable : direction t = ({x}, {y}, {z}) ; la plus proche accessible est {near}, à {away:.3g}°</translation>
        </message>
        <message>
            <source>degenerate: t = {array} has no direction</source>
            <translation type="unfinished">dégénéré : t = {array} n’a pas de direction</translation>
        </message>
        <message>
            <source>unreachable: a margin of {degrees:.4g}° leaves nothing of the workspace; ask for less</source>
            <translation type="unfinished">inatteignable : une marge de {degrees:.4g}° ne laisse rien de l’espace de travail ; demandez moins</translation>
        </message>
        <message>
            <source>degenerate: (η, μ) = ({eta}, {mu}) rad; η within ±π/2 and μ between 0 and π point up</source>
            <translation type="unfinished">dégénéré : (η, μ) = ({eta}, {mu}) rad ; η dans ±π/2 et μ entre 0 et π pointent vers le haut</translation>
        </message>
        <message>
            <source>encoder: {steps} steps per turn; a positive number is needed</source>
            <translation type="unfinished">codeur : {steps} pas par tour ; il faut un nombre positif</translation>
        </message>
        <message>
            <source>device {profile_name} is a {profile_kind}, no tensegrity</source>
            <translation type="unfinished">l’appareil {profile_name} est un {profile_kind}, pas une tenségrité</translation>
        </message>
        <message>
            <source>beta has shape {b_shape}; (2,) is needed</source>
            <translation type="unfinished">beta a la forme {b_shape} ; il faut (2,)</translation>
        </message>
        <message>
            <source>unreachable: no direction for β = {b} rad after {evaluations} evaluations</source>
            <translation type="unfinished">inatteignable : pas de direction pour β = {b} rad après {evaluations} évaluations</translation>
        </message>
        <message>
            <source>degenerate: T stands on A{base_number}; its rhombus has no plane there, turn the guide away</source>
            <translation type="unfinished">dégénéré : T se trouve sur A{base_number} ; son losange n’y a pas de plan, tournez le guide ailleurs</translation>
        </message>
        <message>
            <source>not finite: spheres at {c} with radii {r}</source>
            <translation type="unfinished">non fini : sphères en {c} de rayons {r}</translation>
        </message>
        <message>
            <source>degenerate: the centres of the spheres lie in one line: {c}</source>
            <translation type="unfinished">dégénéré : les centres des sphères sont alignés : {c}</translation>
        </message>
        <message>
            <source>unreachable: spheres with radii {r} m at {c} m have no point in common</source>
            <translation type="unfinished">inatteignable : des sphères de rayons {r} m en {c} m n’ont pas de point commun</translation>
        </message>
        <message>
            <source>tensions must rise from least ({least:g} N) over holding ({holding:g} N) to most ({most:g} N)</source>
            <translation type="unfinished">les tensions doivent croître de least ({least:g} N) à holding ({holding:g} N), puis à most ({most:g} N)</translation>
        </message>
        <message>
            <source>the plan has no {missing} yet: click it in one of the views</source>
            <translation type="unfinished">il manque encore un point au plan ({missing}) : cliquez-le dans une des vues</translation>
        </message>
        <message>
            <source>a region needs an extent both ways: drag from corner to corner</source>
            <translation type="unfinished">une région demande une étendue dans les deux sens : tirez d’un coin à l’autre</translation>
        </message>
        <message>
            <source>the two points are {length:.2f} mm apart; choose points at least {shortest_mm:g} mm apart for a plane through them</source>
            <translation type="unfinished">les deux points sont à {length:.2f} mm l’un de l’autre ; choisissez des points distants d’au moins {shortest_mm:g} mm pour un plan qui passe par eux</translation>
        </message>
        <message>
            <source>no path of {length_mm:g} mm from the anterior skin stays in the body of this CT; place entry and target yourself</source>
            <translation type="unfinished">aucune trajectoire de {length_mm:g} mm depuis la peau antérieure ne reste dans le corps de ce CT ; placez vous-même le point d’entrée et la cible</translation>
        </message>
        <message>
            <source>scoring paths</source>
            <translation type="unfinished">évaluation des trajectoires</translation>
        </message>
        <message>
            <source>paths scored</source>
            <translation type="unfinished">trajectoires évaluées</translation>
        </message>
        <message>
            <source>rotation_deg ({x:g}, {y:g}, {z:g}) must be within ±360°</source>
            <translation type="unfinished">rotation_deg ({x:g}, {y:g}, {z:g}) doit être dans ±360°</translation>
        </message>
        <message>
            <source>entry {entry} and target {target} are {length_mm:.3g} mm apart; a path needs at least {shortest_mm:g} mm: move one of the two points</source>
            <translation type="unfinished">le point d’entrée {entry} et la cible {target} sont à {length_mm:.3g} mm l’un de l’autre ; une trajectoire demande au moins {shortest_mm:g} mm : déplacez l’un des deux points</translation>
        </message>
        <message>
            <source>target {target} lies outside the body: click inside the patient</source>
            <translation type="unfinished">la cible {target} est hors du corps : cliquez dans le patient</translation>
        </message>
        <message>
            <source>{name} {point!r} is not a point of three numbers</source>
            <translation type="unfinished">{name} {point!r} n’est pas un point de trois nombres</translation>
        </message>
        <message>
            <source>{name} has shape {array_shape}; three coordinates (3,) are needed</source>
            <translation type="unfinished">{name} a la forme {array_shape} ; il faut trois coordonnées (3,)</translation>
        </message>
        <message>
            <source>{name} {array} must be finite and within ±{largest_mm:g} mm</source>
            <translation type="unfinished">{name} {array} doit être fini et dans ±{largest_mm:g} mm</translation>
        </message>
        <message>
            <source>leave the patient as is</source>
            <translation type="unfinished">laissez le patient tel quel</translation>
        </message>
        <message>
            <source>turn the patient {angle_deg:.1f}° about {axis_words}</source>
            <translation type="unfinished">tournez le patient de {angle_deg:.1f}° (axe : {axis_words})</translation>
        </message>
        <message>
            <source>the axis (L {left:.2f}, P {posterior:.2f}, S {superior:.2f}) through the entry</source>
            <translation type="unfinished">l’axe (L {left:.2f}, P {posterior:.2f}, S {superior:.2f}) par le point d’entrée</translation>
        </message>
        <message>
            <source>lay the patient {lying} (tilt {tilt:.0f}°)</source>
            <translation type="unfinished">couchez le patient {lying} (inclinaison {tilt:.0f}°)</translation>
        </message>
        <message>
            <source>reachable: tilt {tilt_deg:.1f}°, depth {depth_mm:.1f} mm</source>
            <translation type="unfinished">accessible : inclinaison {tilt_deg:.1f}°, profondeur {depth_mm:.1f} mm</translation>
        </message>
        <message>
            <source>out of reach: {reasons}</source>
            <translation type="unfinished">hors de portée : {reasons}</translation>
        </message>
        <message>
            <source>out of reach: {reasons}. Remedy: {remedy}</source>
            <translation type="unfinished">hors de portée : {reasons}. Remède : {remedy}</translation>
        </message>
        <message>
            <source>upward (tilt {tilt:.1f}° of 180°)</source>
            <translation type="unfinished">vers le haut (inclinaison {tilt:.1f}° sur 180°)</translation>
        </message>
        <message>
            <source>the path runs {way}; the needle enters from above, at most {limit:g}° from vertical</source>
            <translation type="unfinished">la trajectoire va {way} ; l’aiguille entre par le haut, à {limit:g}° au plus de la verticale</translation>
        </message>
        <message>
            <source>tool point ({x:.1f}, {y:.1f}) mm lies outside the robot's workspace</source>
            <translation type="unfinished">le point d’outil ({x:.1f}, {y:.1f}) mm est hors de l’espace de travail du robot</translation>
        </message>
        <message>
            <source>depth {depth_mm:.1f} mm exceeds {limits_depth_limit_mm:g} mm; no rotation shortens a path: choose an entry closer to the target</source>
            <translation type="unfinished">la profondeur {depth_mm:.1f} mm dépasse {limits_depth_limit_mm:g} mm ; aucune rotation ne raccourcit une trajectoire : choisissez un point d’entrée plus proche de la cible</translation>
        </message>
        <message>
            <source>a shift that all share: {sqrt_mm:.2f} mm by the plate</source>
            <translation type="unfinished">un décalage commun à tous : {sqrt_mm:.2f} mm d’après la plaque</translation>
        </message>
        <message>
            <source>a shift that all share is not in it</source>
            <translation type="unfinished">un décalage commun à tous n’y est pas compris</translation>
        </message>
        <message>
            <source>errors of each point as stated</source>
            <translation type="unfinished">erreurs de chaque point telles qu’indiquées</translation>
        </message>
        <message>
            <source>, which the residuals exceed</source>
            <translation type="unfinished">, que les résidus dépassent</translation>
        </message>
        <message>
            <source>shape of the errors by the residuals</source>
            <translation type="unfinished">forme des erreurs d’après les résidus</translation>
        </message>
        <message>
            <source>holds for errors that are as large in every direction</source>
            <translation type="unfinished">vaut pour des erreurs égales dans toutes les directions</translation>
        </message>
        <message>
            <source>the points do not fit the plate, so nothing can be said of the target; see the residuals, touch the named fiducials again</source>
            <translation type="unfinished">les points ne vont pas avec la plaque, on ne peut donc rien dire de la cible ; voyez les résidus et touchez à nouveau les repères nommés</translation>
        </message>
        <message>
            <source>plate {plate_name} has no known place in the robot's frame and no beads were picked: the touches have nothing to agree with; give `place`, or pick the beads in the CT</source>
            <translation type="unfinished">la plaque {plate_name} n’a pas de place connue dans le repère spatial du robot, et aucune bille n’a été choisie : les touchers n’ont rien à quoi se comparer ; donnez `place`, ou choisissez les billes dans le CT</translation>
        </message>
        <message>
            <source>touch {lacking} more {fiducials}</source>
            <translation type="unfinished">encore à toucher : {lacking} {fiducials}</translation>
        </message>
        <message>
            <source>pick {lacking} more {beads} in the CT, or none</source>
            <translation type="unfinished">encore à choisir dans le CT : {lacking} {beads}, ou aucune</translation>
        </message>
        <message>
            <source>two fiducials have the same name: {names}</source>
            <translation type="unfinished">deux repères ont le même nom : {names}</translation>
        </message>
        <message>
            <source>plate {plate_name} has no fiducial {fiducial_name!r}; it has {names}</source>
            <translation type="unfinished">la plaque {plate_name} n’a pas de repère {fiducial_name!r} ; elle a {names}</translation>
        </message>
        <message>
            <source>fiducial {name!r} is given twice; keep one of them</source>
            <translation type="unfinished">le repère {name!r} est donné deux fois ; gardez l’un des deux</translation>
        </message>
        <message>
            <source>no fiducial plate {wanted!r}; valid names: {plate_names}, or the path of a .yaml file</source>
            <translation type="unfinished">il n’y a pas de plaque à repères {wanted!r} ; noms valides : {plate_names}, ou le chemin d’un fichier .yaml</translation>
        </message>
        <message>
            <source>the point {point} lies outside the CT: click a slice</source>
            <translation type="unfinished">le point {point} est hors du CT : cliquez sur une coupe</translation>
        </message>
        <message>
            <source>no bead within {search:.1f} mm of {point}: the brightest voxel is {contrast:.0f} HU above its surroundings, {least_contrast:.0f} are needed</source>
            <translation type="unfinished">aucune bille à moins de {search:.1f} mm de {point} : le voxel le plus clair est à {contrast:.0f} UH au-dessus de son entourage, il en faut {least_contrast:.0f}</translation>
        </message>
        <message>
            <source>the bead at {centre} reaches the edge of the CT: use another one</source>
            <translation type="unfinished">la bille en {centre} atteint le bord du CT : prenez-en une autre</translation>
        </message>
        <message>
            <source>what is bright at {point} is {measured_mm:.1f} mm across, a bead is {bead_mm:.1f} mm (at most {largest_mm:.1f} mm in this CT): bone, or two beads; click on a bead</source>
            <translation type="unfinished">ce qui est clair en {point} mesure {measured_mm:.1f} mm, une bille {bead_mm:.1f} mm (au plus {largest_mm:.1f} mm dans ce CT) : de l’os, ou deux billes ; cliquez sur une bille</translation>
        </message>
        <message>
            <source>{names} names for {points} points</source>
            <translation type="unfinished">noms : {names}, points : {points}</translation>
        </message>
        <message>
            <source>{path} holds no points</source>
            <translation type="unfinished">{path} ne contient pas de points</translation>
        </message>
        <message>
            <source>{path} is no text; give a CSV file with the header name,x_mm,y_mm,z_mm, or YAML</source>
            <translation type="unfinished">{path} n’est pas un texte ; donnez un fichier CSV d’en-tête name,x_mm,y_mm,z_mm, ou du YAML</translation>
        </message>
        <message>
            <source>{path}: column {column} is missing; the first line must be name,x_mm,y_mm,z_mm and may add sd_mm</source>
            <translation type="unfinished">{path} : la colonne {column} manque ; la première ligne doit être name,x_mm,y_mm,z_mm et peut ajouter sd_mm</translation>
        </message>
        <message>
            <source>{path}, {where}: sd_mm {deviation:g} is negative</source>
            <translation type="unfinished">{path}, {where} : sd_mm {deviation:g} est négatif</translation>
        </message>
        <message>
            <source>{path}: a mapping of names to [x, y, z] in mm is needed</source>
            <translation type="unfinished">{path} : il faut une table de noms vers [x, y, z] en mm</translation>
        </message>
        <message>
            <source>{path}, {name}: [x, y, z] in mm is needed, got {entry!r}</source>
            <translation type="unfinished">{path}, {name} : il faut [x, y, z] en mm, pas {entry!r}</translation>
        </message>
        <message>
            <source>{path}, {where}: {entry!r} is not a number</source>
            <translation type="unfinished">{path}, {where} : {entry!r} n’est pas un nombre</translation>
        </message>
        <message>
            <source>{path}, {where}: {entry!r} is not finite</source>
            <translation type="unfinished">{path}, {where} : {entry!r} n’est pas fini</translation>
        </message>
        <message>
            <source>format {format} {version} is not {known_format} 1</source>
            <translation type="unfinished">le format {format} {version} n’est pas {known_format} 1</translation>
        </message>
        <message>
            <source>{reference_points} reference points and {measured_points} measured ones: give each fiducial once in both</source>
            <translation type="unfinished">points de référence : {reference_points}, points mesurés : {measured_points} ; donnez chaque repère une fois dans les deux</translation>
        </message>
        <message>
            <source>two rotations fit these points equally well: the measured ones look like the mirror image of the reference; check the order of the points and the signs of the coordinates</source>
            <translation type="unfinished">deux rotations vont aussi bien avec ces points : les points mesurés ressemblent à l’image en miroir de la référence ; vérifiez l’ordre des points et les signes des coordonnées</translation>
        </message>
        <message>
            <source>{name} points are not a list of three numbers each</source>
            <translation type="unfinished">points ({name}) : ce n’est pas une liste de trois nombres chacun</translation>
        </message>
        <message>
            <source>{name} points have shape {array_shape}; (n, 3) is needed</source>
            <translation type="unfinished">points ({name}) : la forme est {array_shape} ; il faut (n, 3)</translation>
        </message>
        <message>
            <source>{name} point {i} is {point} m: finite numbers within ±{largest:g} m are needed (millimetres where metres are meant?)</source>
            <translation type="unfinished">point {i} ({name}) : {point} m : il faut des nombres finis dans ±{largest:g} m (des millimètres au lieu de mètres ?)</translation>
        </message>
        <message>
            <source>{points_given} {name} {points}: a registration needs at least {fewest}, and {fewest_to_check} to find a wrong one</source>
            <translation type="unfinished">{points_given} {points} ({name}) : un recalage en demande au moins {fewest}, et {fewest_to_check} pour en trouver un faux</translation>
        </message>
        <message>
            <source>the {name} points lie within {extent_mm:.2f} mm of each other: they are one point; touch fiducials that are far apart</source>
            <translation type="unfinished">les points ({name}) sont à moins de {extent_mm:.2f} mm les uns des autres : c’est un seul point ; touchez des repères éloignés les uns des autres</translation>
        </message>
        <message>
            <source>the {name} points lie on one line within {width_mm:.2f} mm: the turn about it stays unknown; add a fiducial beside the line</source>
            <translation type="unfinished">les points ({name}) sont alignés à {width_mm:.2f} mm près : la rotation autour de la droite reste inconnue ; ajoutez un repère à côté de la droite</translation>
        </message>
        <message>
            <source>weights {array}: {count} positive numbers within a factor of 1e6 are needed</source>
            <translation type="unfinished">poids {array} : il faut {count} nombres positifs dans un rapport d’au plus 1e6</translation>
        </message>
        <message>
            <source>screen and needle agree within ± {mm} mm (95 %)</source>
            <translation type="unfinished">l’écran et l’aiguille concordent à ± {mm} mm près (95 %)</translation>
        </message>
        <message>
            <source>TRE at the target: {expected_mm} mm RMS expected, at least 95 % within {within_95_mm} mm ({check_world_condition})</source>
            <translation type="unfinished">TRE à la cible : {expected_mm} mm RMS attendus, au moins 95 % à moins de {within_95_mm} mm ({check_world_condition})</translation>
        </message>
        <message>
            <source>{title}: {fiducials} fiducials, FRE {fre_mm} mm (fit of the points, not accuracy)</source>
            <translation type="unfinished">{title} : repères : {fiducials}, FRE {fre_mm} mm (ajustement des points, pas exactitude)</translation>
        </message>
        <message>
            <source>{title}: FLE {fle_mm} mm, between {lower_mm} and {upper_mm} mm with 95 % ({error_freedom} degrees of freedom)</source>
            <translation type="unfinished">{title} : FLE {fle_mm} mm, entre {lower_mm} et {upper_mm} mm à 95 % (degrés de liberté : {error_freedom})</translation>
        </message>
        <message>
            <source>fiducials {moved} were {verb} in another order: exchanged, they fit within {mm} mm; name them again</source>
            <translation type="unfinished">repères dans un autre ordre ({verb}) : {moved} ; échangés, ils s’ajustent à {mm} mm près ; renommez-les</translation>
        </message>
        <message>
            <source>fiducial {name} lies {distance_mm} mm from where the others put it (they agree within {agreement_mm} mm): do {name} again</source>
            <translation type="unfinished">le repère {name} est à {distance_mm} mm de l’endroit que donnent les autres (ils concordent à {agreement_mm} mm près) : refaites {name}</translation>
        </message>
        <message>
            <source>the {verb} points do not fit the plate: the largest residual is {residual_mm} mm at {name}, the limit is {limit_mm} mm; is it this plate? do all points again</source>
            <translation type="unfinished">les points ({verb}) ne vont pas avec la plaque : le plus grand résidu est de {residual_mm} mm en {name}, la limite de {limit_mm} mm ; est-ce bien cette plaque ? Refaites tous les points</translation>
        </message>
        <message>
            <source>the {verb} points scatter more than careful work explains (FLE {mm} mm); the figure below allows for it</source>
            <translation type="unfinished">les points ({verb}) sont plus dispersés que ne l’explique un travail soigneux (FLE {mm} mm) ; le chiffre ci-dessous en tient compte</translation>
        </message>
        <message>
            <source>lengths between the {verb} points are {off:.1%} too {direction} (± {part_scale_sd:.1%})</source>
            <translation type="unfinished">les longueurs entre les points ({verb}) sont fausses de {off:.1%} : trop {direction} (± {part_scale_sd:.1%})</translation>
        </message>
        <message>
            <source>{finding}: the CT's spacing is wrong, or this is another plate</source>
            <translation type="unfinished">{finding} : l’espacement du CT est faux, ou c’est une autre plaque</translation>
        </message>
        <message>
            <source>{finding}: the cameras were calibrated with a board of another size than said. Measure its line of 100 mm and its squares, calibrate again; or this is another plate</source>
            <translation type="unfinished">{finding} : les caméras ont été étalonnées avec une mire d’une autre taille que celle indiquée. Mesurez son trait de 100 mm et ses carrés, puis refaites l’étalonnage ; ou bien c’est une autre plaque</translation>
        </message>
        <message>
            <source>one of them has no score</source>
            <translation type="unfinished">l’un d’eux n’a pas de note</translation>
        </message>
        <message>
            <source>the exercise says something else under the same version</source>
            <translation type="unfinished">l’exercice dit autre chose sous la même version</translation>
        </message>
        <message>
            <source>what robot it was is not known of one of them</source>
            <translation type="unfinished">pour l’un d’eux, on ne sait pas quel était le robot</translation>
        </message>
        <message>
            <source>what the assistance was is not known of one of them</source>
            <translation type="unfinished">pour l’un d’eux, on ne sait pas quelle était l’assistance</translation>
        </message>
        <message>
            <source>{entry!r} is no number</source>
            <translation type="unfinished">{entry!r} n’est pas un nombre</translation>
        </message>
        <message>
            <source>it ends the program ({fault})</source>
            <translation type="unfinished">il met fin au programme ({fault})</translation>
        </message>
        <message>
            <source>{tissue} at {entered_mm} mm: a number is not finite</source>
            <translation type="unfinished">{tissue} à {entered_mm} mm : un nombre n’est pas fini</translation>
        </message>
        <message>
            <source>{kind!r} is no kind of tissue</source>
            <translation type="unfinished">{kind!r} n’est pas un type de tissu</translation>
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
            <translation type="unfinished">{bone} : contact de la tige de l’aiguille à {depth}, {crossed_mm:.1f} mm traversés</translation>
        </message>
        <message>
            <source>{bone} touched by the shaft at {depth}</source>
            <translation type="unfinished">{bone} : contact de la tige de l’aiguille à {depth}</translation>
        </message>
        <message>
            <source>{bone} touched at {depth}, {crossed_mm:.1f} mm crossed</source>
            <translation type="unfinished">{bone} : contact à {depth}, {crossed_mm:.1f} mm traversés</translation>
        </message>
        <message>
            <source>{bone} touched at {depth}</source>
            <translation type="unfinished">{bone} : contact à {depth}</translation>
        </message>
        <message>
            <source>{tissue} by the shaft at {depth}: grazed</source>
            <translation type="unfinished">{tissue} par la tige de l’aiguille à {depth} : effleurement</translation>
        </message>
        <message>
            <source>{tissue} by the shaft at {depth}: {length_mm:.1f} mm</source>
            <translation type="unfinished">{tissue} par la tige de l’aiguille à {depth} : {length_mm:.1f} mm</translation>
        </message>
        <message>
            <source>{tissue} at {depth}: grazed</source>
            <translation type="unfinished">{tissue} à {depth} : effleurement</translation>
        </message>
        <message>
            <source>{tissue} at {depth}: {length_mm:.1f} mm</source>
            <translation type="unfinished">{tissue} à {depth} : {length_mm:.1f} mm</translation>
        </message>
        <message>
            <source>no metric {name!r}; there are {names}</source>
            <translation type="unfinished">aucun indicateur {name!r} ; il existe {names}</translation>
        </message>
        <message>
            <source>the attempt was never begun</source>
            <translation type="unfinished">l’essai n’a jamais commencé</translation>
        </message>
        <message>
            <source>the needle or its path runs along the patient's length</source>
            <translation type="unfinished">l’aiguille ou sa trajectoire suit l’axe longitudinal du patient</translation>
        </message>
        <message>
            <source>no bone was felt along the needle</source>
            <translation type="unfinished">aucun os n’a été ressenti le long de l’aiguille</translation>
        </message>
        <message>
            <source>the attempt never got that far</source>
            <translation type="unfinished">l’essai n’est pas allé jusque-là</translation>
        </message>
        <message>
            <source>the depth of the tip was not measured in the body</source>
            <translation type="unfinished">la profondeur de la pointe n’a pas été mesurée dans le corps</translation>
        </message>
        <message>
            <source>the tip touched a target where it came in</source>
            <translation type="unfinished">la pointe a touché une cible dès son entrée</translation>
        </message>
        <message>
            <source>the force of the guidance was not recorded</source>
            <translation type="unfinished">la force du guidage n’a pas été enregistrée</translation>
        </message>
        <message>
            <source>the tip ended {straight_mm:.2f} mm from where it entered; a ratio needs at least 1 mm</source>
            <translation type="unfinished">la pointe a fini à {straight_mm:.2f} mm de son point d’entrée ; un rapport demande au moins 1 mm</translation>
        </message>
        <message>
            <source>the lung was not entered</source>
            <translation type="unfinished">le poumon n’a pas été pénétré</translation>
        </message>
        <message>
            <source>no structure of risk was measured</source>
            <translation type="unfinished">aucune structure à risque n’a été mesurée</translation>
        </message>
        <message>
            <source>how long the needle was inside was not recorded</source>
            <translation type="unfinished">la durée passée à l’intérieur par l’aiguille n’a pas été enregistrée</translation>
        </message>
        <message>
            <source>whether the force was at its limit was not recorded</source>
            <translation type="unfinished">on n’a pas enregistré si la force était à sa limite</translation>
        </message>
        <message>
            <source>{statement} ({source})</source>
            <translation type="unfinished">{statement} ({source})</translation>
        </message>
        <message>
            <source>Pleural crossings: {crossed}; aerated lung: {aerated:.0f} mm. In published series {percent:g} % of lung biopsies had a pneumothorax, {drain:g} % a drain.</source>
            <translation type="unfinished">Passages de la plèvre : {crossed} ; poumon aéré : {aerated:.0f} mm. Dans les séries publiées, {percent:g} % des biopsies pulmonaires ont eu un pneumothorax, {drain:g} % un drain.</translation>
        </message>
        <message>
            <source>Pleura punctured {entered} times: more than once, against once, has an odds ratio of {ratio:g}.</source>
            <translation type="unfinished">Ponctions de la plèvre : {entered} ; plus d’une, comparé à une seule, a un odds ratio de {ratio:g}.</translation>
        </message>
        <message>
            <source>A lesion {deep:g} mm deep or more, against less: odds ratio {ratio:g}.</source>
            <translation type="unfinished">Une lésion à {deep:g} mm de profondeur ou plus, comparé à moins : odds ratio {ratio:g}.</translation>
        </message>
        <message>
            <source>Pleura met {angle:.0f}° from straight in: series contradict each other about flat ones; one finds more pneumothorax, one finds none.</source>
            <translation type="unfinished">Plèvre abordée à {angle:.0f}° de la perpendiculaire : sur les angles rasants, les séries se contredisent ; l’une trouve plus de pneumothorax, l’autre non.</translation>
        </message>
        <message>
            <source>Not known here: emphysema (odds ratio {emphysema:g}), a fissure ({fissure:g}) or a bulla ({bulla:g}) crossed; needles of 18 G or thicker ({thick:g}).</source>
            <translation type="unfinished">Inconnus ici : emphysème (odds ratio {emphysema:g}), traversée d’une scissure ({fissure:g}) ou d’une bulle ({bulla:g}) ; aiguilles de 18 G ou plus grosses ({thick:g}).</translation>
        </message>
        <message>
            <source>Of lung biopsies {bled:g} % bled into the lung, {more:g} % of a higher grade; {coughed:g} % coughed blood.</source>
            <translation type="unfinished">Sur les biopsies pulmonaires, {bled:g} % ont saigné dans le poumon, {more:g} % à un grade plus élevé ; {coughed:g} % ont eu une hémoptysie.</translation>
        </message>
        <message>
            <source>Of lung biopsies {least:g} to {most:g} %, by series, had an air embolism.</source>
            <translation type="unfinished">Selon les séries, {least:g} à {most:g} % des biopsies pulmonaires ont eu une embolie gazeuse.</translation>
        </message>
        <message>
            <source>{vessel} met: no published rate of bleeding for that vessel was found.</source>
            <translation type="unfinished">{vessel} : vaisseau rencontré ; aucun taux de saignement publié n’a été trouvé pour lui.</translation>
        </message>
        <message>
            <source>Of liver biopsies {percent:g} % bled majorly.</source>
            <translation type="unfinished">{percent:g} % des biopsies hépatiques ont eu un saignement majeur.</translation>
        </message>
        <message>
            <source>Of kidney biopsies {haematoma:g} % had a haematoma, {transfused:g} % bled so that blood was given.</source>
            <translation type="unfinished">Sur les biopsies rénales, {haematoma:g} % ont eu un hématome, {transfused:g} % un saignement qui a nécessité une transfusion.</translation>
        </message>
        <message>
            <source>Gut</source>
            <translation type="unfinished">Intestin</translation>
        </message>
        <message>
            <source>Heart</source>
            <translation type="unfinished">Cœur</translation>
        </message>
        <message>
            <source>{tissue} met: no published odds are known here.</source>
            <translation type="unfinished">{tissue} : tissu rencontré ; aucun risque publié n’est connu ici.</translation>
        </message>
        <message>
            <source>no error lies within {limit}: give 0 or more</source>
            <translation type="unfinished">aucune erreur ne tient dans {limit} : indiquez 0 ou plus</translation>
        </message>
        <message>
            <source>a wish of 153 respondents (125 radiologists), nobody's measured hand: </source>
            <translation type="unfinished">un souhait de 153 personnes interrogées (dont 125 radiologues), pas une main mesurée : </translation>
        </message>
        <message>
            <source>{wish}of published hands {at_least}{shares} came so near</source>
            <translation type="unfinished">{wish}parmi les mains publiées, sont arrivées aussi près {at_least}{shares}</translation>
        </message>
        <message>
            <source>the tip's path is {length:.2f} m long; paths up to {longest:g} m are compared</source>
            <translation type="unfinished">le parcours de la pointe fait {length:.2f} m ; on compare des parcours jusqu’à {longest:g} m</translation>
        </message>
        <message>
            <source>the score has no row {name!r}; it has {names}</source>
            <translation type="unfinished">la note n’a pas de ligne {name!r} ; elle a {names}</translation>
        </message>
        <message>
            <source>format {format!r}; only {known_format} is known</source>
            <translation type="unfinished">format {format!r} ; seul {known_format} est connu</translation>
        </message>
        <message>
            <source>not a stored score ({reason})</source>
            <translation type="unfinished">ce n’est pas une note enregistrée ({reason})</translation>
        </message>
        <message>
            <source>the tip was tracked for {row:.0f} % of the insertion; {rules_minimum_tracking:g} % are needed</source>
            <translation type="unfinished">la pointe a été suivie pendant {row:.0f} % de la ponction ; il faut {rules_minimum_tracking:g} %</translation>
        </message>
        <message>
            <source>{row_label} is required and cannot be computed: {row_note}</source>
            <translation type="unfinished">{row_label} est exigé et ne peut pas être calculé : {row_note}</translation>
        </message>
        <message>
            <source>it holds {constant}</source>
            <translation type="unfinished">elle contient {constant}</translation>
        </message>
        <message>
            <source>{closest_mm} mm from {name}, limit {limit_mm} mm, at {time} s, inside for {inside_s} s: all must be finite numbers, limit and time inside not negative</source>
            <translation type="unfinished">{closest_mm} mm de {name}, limite {limit_mm} mm, à {time} s, à l’intérieur pendant {inside_s} s : tous les nombres doivent être finis, la limite et le temps à l’intérieur non négatifs</translation>
        </message>
        <message>
            <source>no tissue is called {unknown_name!r}; there are {forbiddable}</source>
            <translation type="unfinished">aucun tissu ne s’appelle {unknown_name!r} ; il existe {forbiddable}</translation>
        </message>
        <message>
            <source>a kind of tissue is forbidden twice</source>
            <translation type="unfinished">un type de tissu est interdit deux fois</translation>
        </message>
        <message>
            <source>a control scan at {time} s of dose {dose} mGy·cm: both must be finite numbers, the dose not negative</source>
            <translation type="unfinished">un scan de contrôle à {time} s avec une dose de {dose} mGy·cm : les deux nombres doivent être finis, la dose non négative</translation>
        </message>
        <message>
            <source>no metric {name!r}; there are {metrics}</source>
            <translation type="unfinished">aucun indicateur {name!r} ; il existe {metrics}</translation>
        </message>
        <message>
            <source>metric {name!r} cannot be used: {metrics_fault}</source>
            <translation type="unfinished">l’indicateur {name!r} est inutilisable : {metrics_fault}</translation>
        </message>
        <message>
            <source>{name}: bands {limits_knots} (expert, good, pass) run against the metric, of which {way} is better</source>
            <translation type="unfinished">{name} : les paliers {limits_knots} (expert, good, pass) vont à l’inverse de l’indicateur, pour lequel {way} vaut mieux</translation>
        </message>
        <message>
            <source>the attempt was aborted: {trajectory_aborted}</source>
            <translation type="unfinished">l’essai a été abandonné : {trajectory_aborted}</translation>
        </message>
        <message>
            <source>the attempt was never begun: it ended before the needle was out of the skin</source>
            <translation type="unfinished">l’essai n’a jamais commencé : il s’est terminé avant que l’aiguille soit sortie de la peau</translation>
        </message>
        <message>
            <source>nothing measured how deep the needle was</source>
            <translation type="unfinished">rien n’a mesuré la profondeur de l’aiguille</translation>
        </message>
        <message>
            <source>the needle never crossed the skin: it was never inserted</source>
            <translation type="unfinished">l’aiguille n’a jamais traversé la peau : elle n’a jamais été introduite</translation>
        </message>
        <message>
            <source>this computer was too slow: the attempt waited {paused:.0f} s for pictures of its own simulated cameras; {allowed:g} s are allowed</source>
            <translation type="unfinished">cet ordinateur était trop lent : l’essai a attendu {paused:.0f} s les images de ses propres caméras simulées ; {allowed:g} s sont permises</translation>
        </message>
        <message>
            <source>the attempt waited {paused:.0f} s for the cameras; {rules_maximum_pause:g} s are allowed</source>
            <translation type="unfinished">l’essai a attendu les caméras {paused:.0f} s ; {rules_maximum_pause:g} s sont permises</translation>
        </message>
        <message>
            <source>the insertion was measured for {duration_s:.2f} s; smoothness needs {shortest:g} to {longest:g} s</source>
            <translation type="unfinished">la ponction a été mesurée pendant {duration_s:.2f} s ; la fluidité demande de {shortest:g} à {longest:g} s</translation>
        </message>
        <message>
            <source>the tip's speed never changed: it has no smoothness</source>
            <translation type="unfinished">la vitesse de la pointe n’a jamais changé : elle n’a pas de fluidité</translation>
        </message>
        <message>
            <source>expert, good, pass and zero must rise or fall strictly in this order; they are </source>
            <translation type="unfinished">expert, good, pass et zero doivent croître ou décroître strictement dans cet ordre ; ce sont </translation>
        </message>
        <message>
            <source>expert, good, pass and zero must be finite and 0 or more, as the sign of a value does not count; they are </source>
            <translation type="unfinished">expert, good, pass et zero doivent être finis et d’au moins 0, car le signe d’une valeur ne compte pas ; ce sont </translation>
        </message>
        <message>
            <source>a value that is NaN has no utility</source>
            <translation type="unfinished">une valeur NaN n’a pas d’utilité</translation>
        </message>
        <message>
            <source>{touches} touches of {targets} targets at {times} s; they must be no more than the targets, of which one at least is needed, one after the other</source>
            <translation type="unfinished">contacts : {touches}, cibles : {targets}, à {times} s ; il ne peut y en avoir plus que de cibles, il faut au moins une cible, l’une après l’autre</translation>
        </message>
        <message>
            <source>a touch at {times} s: times must be finite</source>
            <translation type="unfinished">un contact à {times} s : les temps doivent être finis</translation>
        </message>
        <message>
            <source>agreement is {agreement} m; it must be 0 or more</source>
            <translation type="unfinished">l’accord est de {agreement} m ; il doit être d’au moins 0</translation>
        </message>
        <message>
            <source>no robot held the needle: there is no force</source>
            <translation type="unfinished">aucun robot ne tenait l’aiguille : il n’y a pas de force</translation>
        </message>
        <message>
            <source>the needle was never inserted</source>
            <translation type="unfinished">l’aiguille n’a jamais été introduite</translation>
        </message>
        <message>
            <source>no tissue field told what the needle met</source>
            <translation type="unfinished">aucun champ de tissus n’a dit ce que l’aiguille a rencontré</translation>
        </message>
        <message>
            <source>nothing was to be touched</source>
            <translation type="unfinished">il n’y avait rien à toucher</translation>
        </message>
        <message>
            <source>no target was touched</source>
            <translation type="unfinished">aucune cible n’a été touchée</translation>
        </message>
        <message>
            <source>the needle was out of the body at the end</source>
            <translation type="unfinished">l’aiguille était hors du corps à la fin</translation>
        </message>
        <message>
            <source>the depth of the tip was never measured</source>
            <translation type="unfinished">la profondeur de la pointe n’a jamais été mesurée</translation>
        </message>
        <message>
            <source>the tip was last seen {age:.1f} s before the end</source>
            <translation type="unfinished">la pointe a été vue pour la dernière fois {age:.1f} s avant la fin</translation>
        </message>
        <message>
            <source>{name} has shape {array_shape}; {wanted} is needed, as time has it</source>
            <translation type="unfinished">{name} est de forme {array_shape} ; il faut {wanted}, comme pour le temps</translation>
        </message>
        <message>
            <source>{name} is not finite within ±{largest:g} in {bad} of {samples} samples, first at sample {first}: {array}; leave such samples out</source>
            <translation type="unfinished">{name} n’est pas fini dans ±{largest:g} pour {bad} échantillons sur {samples}, d’abord à l’échantillon {first} : {array} ; omettez ces échantillons</translation>
        </message>
        <message>
            <source>spread has shape {array_shape}; ({n}, 3) is needed, as time has it</source>
            <translation type="unfinished">spread est de forme {array_shape} ; il faut ({n}, 3), comme pour le temps</translation>
        </message>
        <message>
            <source>time {fault} at sample {first}: {time} s after {previous_time} s</source>
            <translation type="unfinished">le temps {fault} à l’échantillon {first} : {time} s après {previous_time} s</translation>
        </message>
        <message>
            <source>axis {axis} at sample {first} is no unit vector</source>
            <translation type="unfinished">l’axe {axis} à l’échantillon {first} n’est pas un vecteur unitaire</translation>
        </message>
        <message>
            <source>unknown phase '{unknown_name}'; phases are {codes}</source>
            <translation type="unfinished">phase inconnue « {unknown_name} » ; les phases sont {codes}</translation>
        </message>
        <message>
            <source>phase must be names or codes of Phase 0 ... {largest_code}</source>
            <translation type="unfinished">phase doit contenir des noms ou des codes de Phase 0 … {largest_code}</translation>
        </message>
        <message>
            <source>phase has shape {codes_shape}; ({n},) is needed, as time has it</source>
            <translation type="unfinished">phase est de forme {codes_shape} ; il faut ({n},), comme pour le temps</translation>
        </message>
        <message>
            <source>depth_valid has shape {flags_shape}; ({n},) is needed</source>
            <translation type="unfinished">depth_valid est de forme {flags_shape} ; il faut ({n},)</translation>
        </message>
        <message>
            <source>how well the tip was known there was not recorded</source>
            <translation type="unfinished">la précision avec laquelle la pointe y était connue n’a pas été enregistrée</translation>
        </message>
        <message>
            <source>how well the tip was known was not recorded</source>
            <translation type="unfinished">la précision avec laquelle la pointe était connue n’a pas été enregistrée</translation>
        </message>
        <message>
            <source>how well the tip was known was not recorded throughout</source>
            <translation type="unfinished">la précision avec laquelle la pointe était connue n’a pas été enregistrée en continu</translation>
        </message>
        <message>
            <source>say why it is admitted, in 1 to {longest_reason} characters: the reason is sealed with it</source>
            <translation type="unfinished">dites en 1 à {longest_reason} caractères pourquoi il est admis : la raison est scellée avec lui</translation>
        </message>
        <message>
            <source>nothing is sealed at this station yet: every attempt counts as it is</source>
            <translation type="unfinished">rien n’est encore scellé à ce poste : chaque essai compte tel quel</translation>
        </message>
        <message>
            <source>{path_stem} is {sentence}; only an unsigned attempt can be admitted</source>
            <translation type="unfinished">{path_stem} est {sentence} ; seul un essai non signé peut être admis</translation>
        </message>
        <message>
            <source>cannot write {out}: {reason}</source>
            <translation type="unfinished">impossible d’écrire {out} : {reason}</translation>
        </message>
        <message>
            <source>without a digest, in {folder}</source>
            <translation type="unfinished">sans empreinte, dans {folder}</translation>
        </message>
        <message>
            <source>the structures {file} of {path_stem}</source>
            <translation type="unfinished">les structures {file} de {path_stem}</translation>
        </message>
        <message>
            <source>the CT {name} of {some}</source>
            <translation type="unfinished">le CT {name} de {some}</translation>
        </message>
        <message>
            <source>its list is too long</source>
            <translation type="unfinished">sa liste est trop longue</translation>
        </message>
        <message>
            <source>{source} is no backup of Acus: {error}</source>
            <translation type="unfinished">{source} n’est pas une sauvegarde d’Acus : {error}</translation>
        </message>
        <message>
            <source>{source} is no backup of Acus: its format is {kind!r}</source>
            <translation type="unfinished">{source} n’est pas une sauvegarde d’Acus : son format est {kind!r}</translation>
        </message>
        <message>
            <source>{source} was written by a newer version of Acus: use that version</source>
            <translation type="unfinished">{source} a été écrit par une version plus récente d’Acus : utilisez cette version</translation>
        </message>
        <message>
            <source>{source} is damaged: {odd_name!r} is missing in it or no name of Acus</source>
            <translation type="unfinished">{source} est endommagé : {odd_name!r} y manque ou n’est pas un nom d’Acus</translation>
        </message>
        <message>
            <source>{source} is damaged at {name}: {error}</source>
            <translation type="unfinished">{source} est endommagé à {name} : {error}</translation>
        </message>
        <message>
            <source>{source} is damaged: {name} is not what was packed</source>
            <translation type="unfinished">{source} est endommagé : {name} n’est pas ce qui avait été archivé</translation>
        </message>
        <message>
            <source>a block of {block_bytes} bytes does not begin with {magic}</source>
            <translation type="unfinished">un bloc de {block_bytes} octets ne commence pas par {magic}</translation>
        </message>
        <message>
            <source>block version {version}; this program reads {known_version}</source>
            <translation type="unfinished">version de bloc {version} ; ce programme lit {known_version}</translation>
        </message>
        <message>
            <source>a block of {rows} rows has {block_bytes} bytes</source>
            <translation type="unfinished">un bloc de {rows} lignes a {block_bytes} octets</translation>
        </message>
        <message>
            <source>a block of {count} columns has no tick numbers</source>
            <translation type="unfinished">un bloc de {count} colonnes n’a pas de numéros de cycle</translation>
        </message>
        <message>
            <source>a block of 0 rows has {body_bytes} bytes of numbers</source>
            <translation type="unfinished">un bloc de 0 ligne a {body_bytes} octets de nombres</translation>
        </message>
        <message>
            <source>a block of {rows} rows has {check_bytes} bytes of checks</source>
            <translation type="unfinished">un bloc de {rows} lignes a {check_bytes} octets de contrôle</translation>
        </message>
        <message>
            <source>altered after it was signed</source>
            <translation type="unfinished">modifié après sa signature</translation>
        </message>
        <message>
            <source>declared void by the instructor</source>
            <translation type="unfinished">déclaré nul par le formateur</translation>
        </message>
        <message>
            <source>not sealed by this station</source>
            <translation type="unfinished">non scellé par ce poste</translation>
        </message>
        <message>
            <source>carried out by the arm</source>
            <translation type="unfinished">exécuté par le bras</translation>
        </message>
        <message>
            <source>not scored or void</source>
            <translation type="unfinished">sans note ou nul</translation>
        </message>
        <message>
            <source>version {entry_version} of the exercise</source>
            <translation type="unfinished">version {entry_version} de l’exercice</translation>
        </message>
        <message>
            <source>the exercise said something else</source>
            <translation type="unfinished">l’exercice disait autre chose</translation>
        </message>
        <message>
            <source>{name} has {size:.1f} MB and would take more than {allowed:.0f} MB of memory to be read, which no attempt does: it is damaged or hostile; move it out of the folder</source>
            <translation type="unfinished">{name} fait {size:.1f} Mo et demanderait plus de {allowed:.0f} Mo de mémoire à la lecture, ce qu’aucun essai ne fait : le fichier est endommagé ou malveillant ; retirez-le du dossier</translation>
        </message>
        <message>
            <source>it holds more than the {most} bytes that it should</source>
            <translation type="unfinished">il contient plus que les {most} octets prévus</translation>
        </message>
        <message>
            <source>whether calibration {calibration} is still good is not known: {unknown}</source>
            <translation type="unfinished">on ne sait pas si l’étalonnage {calibration} est encore bon : {unknown}</translation>
        </message>
        <message>
            <source>the cameras' calibration {calibration} was later found bad: {reason}</source>
            <translation type="unfinished">l’étalonnage {calibration} des caméras s’est révélé mauvais par la suite : {reason}</translation>
        </message>
        <message>
            <source>a checkpoint does not begin with {magic}</source>
            <translation type="unfinished">un point de reprise ne commence pas par {magic}</translation>
        </message>
        <message>
            <source>checkpoint version {version}; this program reads {known_version}</source>
            <translation type="unfinished">version {version} du point de reprise ; ce programme lit {known_version}</translation>
        </message>
        <message>
            <source>the checkpoint cannot be read: {error}</source>
            <translation type="unfinished">le point de reprise ne peut pas être lu : {error}</translation>
        </message>
        <message>
            <source>{numbers_given} numbers for {slots} slots and {sizes} more</source>
            <translation type="unfinished">nombres : {numbers_given}, pour emplacements : {slots}, et en plus : {sizes}</translation>
        </message>
        <message>
            <source>the robot's loop does not run</source>
            <translation type="unfinished">la boucle de commande du robot ne tourne pas</translation>
        </message>
        <message>
            <source>wait a moment; if it stays so, check cable and power, start the exercise again</source>
            <translation type="unfinished">attendez un instant ; si cela persiste, vérifiez le câble et l’alimentation, puis relancez l’exercice</translation>
        </message>
        <message>
            <source>simulated robot: its zero is known</source>
            <translation type="unfinished">robot simulé : son zéro est connu</translation>
        </message>
        <message>
            <source>homed since it was switched on</source>
            <translation type="unfinished">prise d’origine faite depuis la mise sous tension</translation>
        </message>
        <message>
            <source>not homed since it was switched on</source>
            <translation type="unfinished">pas de prise d’origine depuis la mise sous tension</translation>
        </message>
        <message>
            <source>menu Robot, Commissioning, step Homing</source>
            <translation type="unfinished">menu Robot, Mise en service, étape Prise d’origine</translation>
        </message>
        <message>
            <source>simulated robot: its signs are known</source>
            <translation type="unfinished">robot simulé : ses signes sont connus</translation>
        </message>
        <message>
            <source>motors and encoders agree</source>
            <translation type="unfinished">les moteurs et les codeurs concordent</translation>
        </message>
        <message>
            <source>not checked since it was switched on</source>
            <translation type="unfinished">pas vérifié depuis la mise sous tension</translation>
        </message>
        <message>
            <source>menu Robot, Commissioning, step Signs</source>
            <translation type="unfinished">menu Robot, Mise en service, étape Vérification des signes</translation>
        </message>
        <message>
            <source>do what the message says; see the page Robot</source>
            <translation type="unfinished">faites ce que dit le message ; voir la page Robot</translation>
        </message>
        <message>
            <source>joint angles come late, so the force is held back</source>
            <translation type="unfinished">les angles des articulations arrivent en retard, la force est donc limitée</translation>
        </message>
        <message>
            <source>check the robot's cable; close other programs</source>
            <translation type="unfinished">vérifiez le câble du robot ; fermez les autres programmes</translation>
        </message>
        <message>
            <source>cleared for its full force</source>
            <translation type="unfinished">autorisé pour sa pleine force</translation>
        </message>
        <message>
            <source>the robot has not said yet</source>
            <translation type="unfinished">le robot n’a encore rien signalé</translation>
        </message>
        <message>
            <source>plug both cameras in; menu Cameras</source>
            <translation type="unfinished">branchez les deux caméras ; menu Caméras</translation>
        </message>
        <message>
            <source>both bright and sharp, {rates} a second</source>
            <translation type="unfinished">toutes deux claires et nettes, {rates} par seconde</translation>
        </message>
        <message>
            <source>found in both pictures</source>
            <translation type="unfinished">trouvé dans les deux images</translation>
        </message>
        <message>
            <source>no pictures yet</source>
            <translation type="unfinished">pas encore d’images</translation>
        </message>
        <message>
            <source>only one camera</source>
            <translation type="unfinished">une seule caméra</translation>
        </message>
        <message>
            <source>push the needle on until both cameras see the red band; look for other red things</source>
            <translation type="unfinished">avancez l’aiguille jusqu’à ce que les deux caméras voient la bande rouge ; cherchez d’autres objets rouges</translation>
        </message>
        <message>
            <source>no point yet</source>
            <translation type="unfinished">pas encore de point</translation>
        </message>
        <message>
            <source>the marker must be seen by both cameras</source>
            <translation type="unfinished">le marqueur doit être vu par les deux caméras</translation>
        </message>
        <message>
            <source>a camera was moved, or robot and cameras differ: `acus calibrate world`</source>
            <translation type="unfinished">une caméra a bougé, ou bien robot et caméras ne concordent pas : `acus calibrate world`</translation>
        </message>
        <message>
            <source>a camera was bumped? calibrate again: menu Cameras</source>
            <translation type="unfinished">une caméra a été heurtée ? refaites l’étalonnage : menu Caméras</translation>
        </message>
        <message>
            <source>Touch one point</source>
            <translation type="unfinished">Toucher un point</translation>
        </message>
        <message>
            <source>not touched yet</source>
            <translation type="unfinished">pas encore touché</translation>
        </message>
        <message>
            <source>rest the tip in a known mark and hold still for a second</source>
            <translation type="unfinished">posez la pointe sur un repère connu et ne bougez plus pendant une seconde</translation>
        </message>
        <message>
            <source>{touch_name}: {distance:.2f} mm off, measured to ± {radius:.2f} mm (95 %)</source>
            <translation type="unfinished">{touch_name} : écart de {distance:.2f} mm, mesuré à ± {radius:.2f} mm (95 %)</translation>
        </message>
        <message>
            <source>the cameras do not measure this point well enough to tell: look at their pictures and rate, touch again</source>
            <translation type="unfinished">les caméras ne mesurent pas assez bien ce point pour conclure : regardez leurs images et leur cadence, puis touchez-le de nouveau</translation>
        </message>
        <message>
            <source>the limit is {touch_tolerance_mm:.1f} mm</source>
            <translation type="unfinished">la limite est de {touch_tolerance_mm:.1f} mm</translation>
        </message>
        <message>
            <source>{limit}: touch again; is it {touch_name}, is the plate in its place? then check with all fiducials: menu Checks, Registration check</source>
            <translation type="unfinished">{limit} : touchez de nouveau ; est-ce bien {touch_name}, la plaque est-elle en place ? vérifiez ensuite avec tous les repères : menu Vérifications, Vérification du recalage</translation>
        </message>
        <message>
            <source>a block ends after {block_bytes} bytes in a column</source>
            <translation type="unfinished">un bloc se termine après {block_bytes} octets au milieu d’une colonne</translation>
        </message>
        <message>
            <source>a column is stored in a way, {code}, that is not known</source>
            <translation type="unfinished">une colonne est enregistrée d’une manière, {code}, qui n’est pas connue</translation>
        </message>
        <message>
            <source>a column repeats column {index}, which is not before it</source>
            <translation type="unfinished">une colonne répète la colonne {index}, qui ne la précède pas</translation>
        </message>
        <message>
            <source>hand {hand!r} is not known; valid names: {hands}</source>
            <translation type="unfinished">la main {hand!r} n’est pas connue ; noms valides : {hands}</translation>
        </message>
        <message>
            <source>too slow: the attempt waited {waited:.0f} s for its simulated cameras</source>
            <translation type="unfinished">trop lent : l’essai a attendu ses caméras simulées pendant {waited:.0f} s</translation>
        </message>
        <message>
            <source>too slow by {lost:.0f} s: the simulated world was slowed with it</source>
            <translation type="unfinished">trop lent de {lost:.0f} s : le monde simulé a été ralenti d’autant</translation>
        </message>
        <message>
            <source>control scan {scan_number} at {time:.1f} s: {order_slices} slices of {order_slice_mm:g} mm about z {order_centre_mm:.1f} mm, {seen_words}, {dose:.1f} mGy·cm ({teaching_estimate})</source>
            <translation type="unfinished">scan de contrôle {scan_number} à {time:.1f} s : coupes : {order_slices} de {order_slice_mm:g} mm autour de z {order_centre_mm:.1f} mm, {seen_words}, {dose:.1f} mGy·cm ({teaching_estimate})</translation>
        </message>
        <message>
            <source>no control scan: the needle's depth is not measured now, so that a picture would be a guess; nothing was counted. Let both cameras see the marker and press again</source>
            <translation type="unfinished">pas de scan de contrôle : la profondeur de l’aiguille n’est pas mesurée en ce moment, une image serait donc devinée ; rien n’a été compté. Faites en sorte que les deux caméras voient le marqueur, puis appuyez de nouveau</translation>
        </message>
        <message>
            <source>closes on {closes}, before it opens on {opens}</source>
            <translation type="unfinished">ferme le {closes}, avant d’ouvrir le {opens}</translation>
        </message>
        <message>
            <source>{exercise_name!r} stands there twice: an exercise has one place</source>
            <translation type="unfinished">{exercise_name!r} y figure deux fois : un exercice n’a qu’une place</translation>
        </message>
        <message>
            <source>{name!r} is no course; there: {known}</source>
            <translation type="unfinished">{name!r} n’est pas un cours ; il existe : {known}</translation>
        </message>
        <message>
            <source>{item_exercise}: no such exercise in the library</source>
            <translation type="unfinished">{item_exercise} : aucun exercice de ce nom dans la bibliothèque</translation>
        </message>
        <message>
            <source>{item_exercise}: the library has version {known}, the course pins version {item_version}</source>
            <translation type="unfinished">{item_exercise} : la bibliothèque a la version {known}, le cours impose la version {item_version}</translation>
        </message>
        <message>
            <source>{named} is no exercise of the course {course_title}</source>
            <translation type="unfinished">{named} n’est pas un exercice du cours {course_title}</translation>
        </message>
        <message>
            <source>it opens on {item_opens}</source>
            <translation type="unfinished">il ouvre le {item_opens}</translation>
        </message>
        <message>
            <source>it closed on {item_closes}</source>
            <translation type="unfinished">il a fermé le {item_closes}</translation>
        </message>
        <message>
            <source>all {item_attempts} attempts are used</source>
            <translation type="unfinished">les {item_attempts} essais sont tous utilisés</translation>
        </message>
        <message>
            <source>the one attempt is used</source>
            <translation type="unfinished">l’unique essai est utilisé</translation>
        </message>
        <message>
            <source>as its files are</source>
            <translation type="unfinished">tel que dans ses fichiers</translation>
        </message>
        <message>
            <source>cannot be deleted: {error_strerror}</source>
            <translation type="unfinished">ne peut pas être supprimé : {error_strerror}</translation>
        </message>
        <message>
            <source>was written by a newer version of Acus (form {found_version}, this one knows {known_version}): use that version</source>
            <translation type="unfinished">a été écrit par une version plus récente d’Acus (forme {found_version}, celle-ci connaît {known_version}) : utilisez cette version</translation>
        </message>
        <message>
            <source>the {database_name} {path} {reason}</source>
            <translation type="unfinished">{database_name} {path} {reason}</translation>
        </message>
        <message>
            <source>effect {effect} is computed by its model {model} from here on</source>
            <translation type="unfinished">l’effet {effect} est calculé par son modèle {model} à partir d’ici</translation>
        </message>
        <message>
            <source>{lie} in {folder}, where earlier versions kept attempts: `acus session gather` brings yours here, `acus session list --folder {folder}` lists all</source>
            <translation type="unfinished">{lie} dans {folder}, où les versions antérieures rangeaient les essais : `acus session gather` amène les vôtres ici, `acus session list --folder {folder}` les liste tous</translation>
        </message>
        <message>
            <source>cannot bring attempts here: {place}: {error_strerror}</source>
            <translation type="unfinished">impossible d’amener les essais ici : {place} : {error_strerror}</translation>
        </message>
        <message>
            <source>cannot delete: {error_strerror}</source>
            <translation type="unfinished">suppression impossible : {error_strerror}</translation>
        </message>
        <message>
            <source>the record's plan has no {error}</source>
            <translation type="unfinished">il manque {error} au plan de l’enregistrement</translation>
        </message>
        <message>
            <source>the record's plan is not usable: {error}</source>
            <translation type="unfinished">le plan de l’enregistrement est inutilisable : {error}</translation>
        </message>
        <message>
            <source>{agreed} of {agreeing} pictures agree so far</source>
            <translation type="unfinished">images concordantes jusqu’ici : {agreed} sur {agreeing}</translation>
        </message>
        <message>
            <source>the cameras' depth jumped by {jump_mm:.0f} mm, faster than a hand moves a needle: {count}</source>
            <translation type="unfinished">la profondeur donnée par les caméras a sauté de {jump_mm:.0f} mm, plus vite qu’une main ne déplace une aiguille : {count}</translation>
        </message>
        <message>
            <source>the cameras have just found the marker: {count}</source>
            <translation type="unfinished">les caméras viennent de trouver le marqueur : {count}</translation>
        </message>
        <message>
            <source>the robot gives no needle direction</source>
            <translation type="unfinished">le robot ne donne pas de direction de l’aiguille</translation>
        </message>
        <message>
            <source>the robot gives no needle position</source>
            <translation type="unfinished">le robot ne donne pas de position de l’aiguille</translation>
        </message>
        <message>
            <source>the encoder values are {text_ms} old, the limit is {encoder_zero:.0f} ms</source>
            <translation type="unfinished">les valeurs des codeurs datent de {text_ms}, la limite est de {encoder_zero:.0f} ms</translation>
        </message>
        <message>
            <source>an unknown time</source>
            <translation type="unfinished">un temps inconnu</translation>
        </message>
        <message>
            <source>session id {session_id!r} is not usable: letters, digits, '.', '_' and '-', at most 64, beginning with a letter or digit</source>
            <translation type="unfinished">l’identifiant de séance {session_id!r} n’est pas utilisable : lettres, chiffres, '.', '_' et '-', 64 au plus, en commençant par une lettre ou un chiffre</translation>
        </message>
        <message>
            <source>{name}: {row!r} in the index, {right!r} by the record</source>
            <translation type="unfinished">{name} : {row!r} dans l’index, {right!r} d’après l’enregistrement</translation>
        </message>
        <message>
            <source>its row was not written by this station</source>
            <translation type="unfinished">sa ligne n’a pas été écrite par ce poste</translation>
        </message>
        <message>
            <source>the robot is not homed</source>
            <translation type="unfinished">la prise d’origine du robot n’est pas faite</translation>
        </message>
        <message>
            <source>{path_stem} is being written by a running program: end its attempt there, or try again {quiet_s:.0f} s after that program has gone</source>
            <translation type="unfinished">{path_stem} est en cours d’écriture par un programme : terminez-y l’essai, ou réessayez {quiet_s:.0f} s après la fin de ce programme</translation>
        </message>
        <message>
            <source>cannot recover {path}: {error_strerror}</source>
            <translation type="unfinished">impossible de récupérer {path} : {error_strerror}</translation>
        </message>
        <message>
            <source>{path_stem} was {reason} and cannot be recovered from itself; a backup may hold it whole (`acus store restore`)</source>
            <translation type="unfinished">{path_stem} a été {reason} et ne peut pas être récupéré à partir de lui-même ; une sauvegarde le contient peut-être en entier (`acus store restore`)</translation>
        </message>
        <message>
            <source>cannot write in {folder}: {error_strerror}; nothing was changed</source>
            <translation type="unfinished">impossible d’écrire dans {folder} : {error_strerror} ; rien n’a été modifié</translation>
        </message>
        <message>
            <source>cannot change {problem_filename}: {problem_strerror}; it is tried again at the next start</source>
            <translation type="unfinished">impossible de modifier {problem_filename} : {problem_strerror} ; une nouvelle tentative aura lieu au prochain démarrage</translation>
        </message>
        <message>
            <source>another program has been changing {folder} for {patience:g} s: wait until it is done, then try again</source>
            <translation type="unfinished">un autre programme modifie {folder} depuis {patience:g} s : attendez qu’il ait fini, puis réessayez</translation>
        </message>
        <message>
            <source>'{event}' is not possible while {attempt_state}; possible: {names}</source>
            <translation type="unfinished">« {event} » n’est pas possible dans l’état {attempt_state} ; possible : {names}</translation>
        </message>
        <message>
            <source>'{event}' at {time} s lies before the last change at {attempt_since} s</source>
            <translation type="unfinished">« {event} » à {time} s précède le dernier changement, à {attempt_since} s</translation>
        </message>
        <message>
            <source>session {header_id} exists already ({path}): every attempt needs its own id</source>
            <translation type="unfinished">la séance {header_id} existe déjà ({path}) : chaque essai demande son propre identifiant</translation>
        </message>
        <message>
            <source>cannot record to {path}: {reason}</source>
            <translation type="unfinished">impossible d’enregistrer dans {path} : {reason}</translation>
        </message>
        <message>
            <source>the record {path} is not open</source>
            <translation type="unfinished">l’enregistrement {path} n’est pas ouvert</translation>
        </message>
        <message>
            <source>cannot record to {folder}: it is a file, not a folder</source>
            <translation type="unfinished">impossible d’enregistrer dans {folder} : c’est un fichier, pas un dossier</translation>
        </message>
        <message>
            <source>the cameras saw the needle for less than a second of this attempt</source>
            <translation type="unfinished">les caméras ont vu l’aiguille moins d’une seconde pendant cet essai</translation>
        </message>
        <message>
            <source>{exercise!r} is no identifier of an exercise</source>
            <translation type="unfinished">{exercise!r} n’est pas un identifiant d’exercice</translation>
        </message>
        <message>
            <source>the loop does not run</source>
            <translation type="unfinished">la boucle de commande ne tourne pas</translation>
        </message>
        <message>
            <source>the loop has stopped: its newest state is {age:.1f} s old</source>
            <translation type="unfinished">la boucle de commande s’est arrêtée : son dernier état date de {age:.1f} s</translation>
        </message>
        <message>
            <source>the robot is still starting: begin once it reports its pose</source>
            <translation type="unfinished">le robot démarre encore : commencez dès qu’il signale sa pose</translation>
        </message>
        <message>
            <source>the program has had a fault: close the exercise, open it again</source>
            <translation type="unfinished">le programme a eu une défaillance : fermez l’exercice, puis rouvrez-le</translation>
        </message>
        <message>
            <source>the patient holds the breath, for {now_left:.0f} s at most</source>
            <translation type="unfinished">le patient retient sa respiration, encore {now_left:.0f} s au plus</translation>
        </message>
        <message>
            <source>the patient could hold no longer and breathes: release him, and ask again</source>
            <translation type="unfinished">le patient n’a pas pu tenir plus longtemps et respire : laissez-le respirer, puis redemandez-lui</translation>
        </message>
        <message>
            <source>the patient is told to hold</source>
            <translation type="unfinished">le patient doit retenir sa respiration</translation>
        </message>
        <message>
            <source>the patient may breathe</source>
            <translation type="unfinished">le patient peut respirer</translation>
        </message>
        <message>
            <source>pad scale needs a path length and a tolerance between 0 and 10 m, got {length} and {tolerance}</source>
            <translation type="unfinished">l’échelle de la cible de visée demande une longueur de trajectoire et une tolérance entre 0 et 10 m, reçu {length} et {tolerance}</translation>
        </message>
        <message>
            <source>tilt limit {limit} rad is outside [0, π/2)</source>
            <translation type="unfinished">la limite d’inclinaison {limit} rad est hors de [0, π/2)</translation>
        </message>
        <message>
            <source>hand limits need a tilt in [0, π/2) and shallowest &lt; deepest, got {this}</source>
            <translation type="unfinished">les limites de la main demandent une inclinaison dans [0, π/2) et shallowest &lt; deepest, reçu {this}</translation>
        </message>
        <message>
            <source>a handle needs a tool longer than {least_outside} m and shorter than 10 m and a reach between 0 and 10 m, got {this}</source>
            <translation type="unfinished">une poignée demande un instrument de plus de {least_outside} m et de moins de 10 m, et une portée entre 0 et 10 m, reçu {this}</translation>
        </message>
        <message>
            <source>depth step {step} is not finite</source>
            <translation type="unfinished">le pas de profondeur {step} n’est pas fini</translation>
        </message>
        <message>
            <source>there is an instructor already: change the password instead</source>
            <translation type="unfinished">il y a déjà un formateur : changez plutôt le mot de passe</translation>
        </message>
        <message>
            <source>no instructor is set: `acus people instructor` sets a password</source>
            <translation type="unfinished">aucun formateur n’est défini : `acus people instructor` fixe un mot de passe</translation>
        </message>
        <message>
            <source>this recovery key is one of an earlier build, in a form that is no longer read: change the password with the one that holds (`acus people instructor`), which prints a new recovery key; if nobody knows it, move {folder} away and begin a new list of people</source>
            <translation type="unfinished">cette clé de récupération vient d’une version antérieure, sous une forme qui n’est plus lue : changez le mot de passe au moyen de celui qui est valable (`acus people instructor`), ce qui imprime une nouvelle clé de récupération ; si personne ne le connaît, mettez {folder} de côté et commencez une nouvelle liste de personnes</translation>
        </message>
        <message>
            <source>{pseudonym!r} is no student here; there: {some}</source>
            <translation type="unfinished">{pseudonym!r} n’est pas un étudiant d’ici ; il existe : {some}</translation>
        </message>
        <message>
            <source>{line_pseudonym!r} is taken: choose another pseudonym</source>
            <translation type="unfinished">{line_pseudonym!r} est déjà pris : choisissez un autre pseudonyme</translation>
        </message>
        <message>
            <source>{no_sign_in}: try again</source>
            <translation type="unfinished">{no_sign_in} : réessayez</translation>
        </message>
        <message>
            <source>{path} is damaged: bring it back from a backup, or move it away to go on without names</source>
            <translation type="unfinished">{path} est endommagé : reprenez-le d’une sauvegarde, ou mettez-le de côté pour continuer sans noms</translation>
        </message>
        <message>
            <source>a password needs at least {shortest_password} characters</source>
            <translation type="unfinished">un mot de passe demande au moins {shortest_password} caractères</translation>
        </message>
        <message>
            <source>the people of {whose} were written by a newer version of Acus: use that version; nothing was changed</source>
            <translation type="unfinished">les personnes de {whose} ont été écrites par une version plus récente d’Acus : utilisez cette version ; rien n’a été modifié</translation>
        </message>
        <message>
            <source>it is empty, or of another program</source>
            <translation type="unfinished">elle est vide, ou vient d’un autre programme</translation>
        </message>
        <message>
            <source>{students} ({shown}): their attempts are nobody's here</source>
            <translation type="unfinished">{students} ({shown}) : leurs essais ne sont ici à personne</translation>
        </message>
        <message>
            <source>it has no table {name!r}</source>
            <translation type="unfinished">elle n’a pas de table {name!r}</translation>
        </message>
        <message>
            <source>persons.key holds {key!r}</source>
            <translation type="unfinished">persons.key contient {key!r}</translation>
        </message>
        <message>
            <source>persons.pseudonym: {error}</source>
            <translation type="unfinished">persons.pseudonym : {error}</translation>
        </message>
        <message>
            <source>persons.pseudonym holds one twice</source>
            <translation type="unfinished">persons.pseudonym en contient un en double</translation>
        </message>
        <message>
            <source>the people of {whose} cannot be restored: {reason}; nothing was changed</source>
            <translation type="unfinished">les personnes de {whose} ne peuvent pas être restaurées : {reason} ; rien n’a été modifié</translation>
        </message>
        <message>
            <source>{path_name} holds no plan: it was cut off at its beginning</source>
            <translation type="unfinished">{path_name} ne contient pas de plan : il a été coupé à son début</translation>
        </message>
        <message>
            <source>{path_name} holds no session: </source>
            <translation type="unfinished">{path_name} ne contient pas de séance : </translation>
        </message>
        <message>
            <source>compared were only the slots that the record holds by value</source>
            <translation type="unfinished">seuls ont été comparés les emplacements dont l’enregistrement contient la valeur</translation>
        </message>
        <message>
            <source>{count} ticks from tick {first} on are not in the record</source>
            <translation type="unfinished">cycles absents de l’enregistrement à partir du cycle {first} : {count}</translation>
        </message>
        <message>
            <source>the replay ends there: {left} recorded ticks were not recomputed</source>
            <translation type="unfinished">la relecture s’arrête là : cycles enregistrés non recalculés : {left}</translation>
        </message>
        <message>
            <source>with another build, differences in the last digits are expected</source>
            <translation type="unfinished">avec une autre version compilée, des différences dans les dernières décimales sont normales</translation>
        </message>
        <message>
            <source>identical over {ticks} ticks ({seconds:.1f} s)</source>
            <translation type="unfinished">identique sur {ticks} cycles ({seconds:.1f} s)</translation>
        </message>
        <message>
            <source>differs from tick {first_difference_tick} on: {difference}</source>
            <translation type="unfinished">diffère à partir du cycle {first_difference_tick} : {difference}</translation>
        </message>
        <message>
            <source>; the largest difference is in tick {most_seen_at}: {difference}</source>
            <translation type="unfinished">; la plus grande différence est au cycle {most_seen_at} : {difference}</translation>
        </message>
        <message>
            <source>at {d_time:.4f} s, in a slot that is not recorded in every tick</source>
            <translation type="unfinished">à {d_time:.4f} s, dans un emplacement qui n’est pas enregistré à chaque cycle</translation>
        </message>
        <message>
            <source> (as seen in tick {d_seen_at})</source>
            <translation type="unfinished"> (tel que vu au cycle {d_seen_at})</translation>
        </message>
        <message>
            <source>{d_slot} was {d_recorded!r}, is now {d_recomputed!r}{size}{where}</source>
            <translation type="unfinished">{d_slot} était {d_recorded!r}, est maintenant {d_recomputed!r}{size}{where}</translation>
        </message>
        <message>
            <source>it holds no checkpoint of the loop: its beginning is damaged</source>
            <translation type="unfinished">il ne contient pas de point de reprise de la boucle de commande : son début est endommagé</translation>
        </message>
        <message>
            <source>it holds no tick of the loop</source>
            <translation type="unfinished">il ne contient aucun cycle de la boucle de commande</translation>
        </message>
        <message>
            <source>ticks {start} to {tick} are missing at its beginning</source>
            <translation type="unfinished">les cycles {start} à {tick} manquent à son début</translation>
        </message>
        <message>
            <source>its program's state had other slots than this one's: {missing}</source>
            <translation type="unfinished">l’état de son programme avait d’autres emplacements que celui-ci : {missing}</translation>
        </message>
        <message>
            <source>this record cannot be replayed: {reason}</source>
            <translation type="unfinished">cet enregistrement ne peut pas être relu : {reason}</translation>
        </message>
        <message>
            <source>this record cannot be replayed: models were chosen while it ran</source>
            <translation type="unfinished">cet enregistrement ne peut pas être relu : des modèles ont été choisis pendant qu’il tournait</translation>
        </message>
        <message>
            <source>the simulated robot</source>
            <translation type="unfinished">robot simulé</translation>
        </message>
        <message>
            <source>{ticks} ticks ({seconds:.1f} s at {rate_hz:.0f} Hz) of {robot}, {missed} deadlines missed</source>
            <translation type="unfinished">{ticks} cycles ({seconds:.1f} s à {rate_hz:.0f} Hz), {robot}, échéances manquées : {missed}</translation>
        </message>
        <message>
            <source>can be replayed: add --check</source>
            <translation type="unfinished">peut être relu : ajoutez --check</translation>
        </message>
        <message>
            <source>inputs that change (how often): {inputs}</source>
            <translation type="unfinished">entrées qui changent (combien de fois) : {inputs}</translation>
        </message>
        <message>
            <source>{count} ticks from tick {first} on are missing</source>
            <translation type="unfinished">cycles manquants à partir du cycle {first} : {count}</translation>
        </message>
        <message>
            <source>{source} is no backup of Acus, or damaged: {error}</source>
            <translation type="unfinished">{source} n’est pas une sauvegarde d’Acus, ou est endommagé : {error}</translation>
        </message>
        <message>
            <source>cannot restore {source}: {reason} ({error_filename})</source>
            <translation type="unfinished">impossible de restaurer {source} : {reason} ({error_filename})</translation>
        </message>
        <message>
            <source>the names in {at_source} are damaged; nothing was changed</source>
            <translation type="unfinished">les noms dans {at_source} sont endommagés ; rien n’a été modifié</translation>
        </message>
        <message>
            <source>altered after it was signed: {check}; it has no points</source>
            <translation type="unfinished">modifié après sa signature : {check} ; l’essai n’a pas de points</translation>
        </message>
        <message>
            <source>the attempt left nothing to show: no valid pose</source>
            <translation type="unfinished">l’essai n’a rien laissé à montrer : aucune pose valide</translation>
        </message>
        <message>
            <source>{nearness}; inside for {inside_s:.1f} s</source>
            <translation type="unfinished">{nearness} ; à l’intérieur pendant {inside_s:.1f} s</translation>
        </message>
        <message>
            <source>{depth_mm:.1f} mm deep in {structure}</source>
            <translation type="unfinished">à {depth_mm:.1f} mm de profondeur dans {structure}</translation>
        </message>
        <message>
            <source>{distance_mm:.1f} mm from {structure}</source>
            <translation type="unfinished">à {distance_mm:.1f} mm de {structure}</translation>
        </message>
        <message>
            <source>needle {place} at the closest; limit {limit_mm:g} mm: too near</source>
            <translation type="unfinished">aiguille au plus près {place} ; limite {limit_mm:g} mm : trop près</translation>
        </message>
        <message>
            <source>needle {place} at the closest; limit {limit_mm:g} mm: kept</source>
            <translation type="unfinished">aiguille au plus près {place} ; limite {limit_mm:g} mm : respectée</translation>
        </message>
        <message>
            <source>{whose}a PIN has 4 to 12 digits</source>
            <translation type="unfinished">{whose}un code PIN a 4 à 12 chiffres</translation>
        </message>
        <message>
            <source>the pseudonym is empty: give one</source>
            <translation type="unfinished">le pseudonyme est vide : donnez-en un</translation>
        </message>
        <message>
            <source>the pseudonym {beginning!r}… has over {longest_pseudonym} characters</source>
            <translation type="unfinished">le pseudonyme {beginning!r}… a plus de {longest_pseudonym} caractères</translation>
        </message>
        <message>
            <source>{pseudonym!r} cannot be a pseudonym: letters, digits, blanks and . _ @ + - only, beginning with a letter or digit</source>
            <translation type="unfinished">{pseudonym!r} ne peut pas être un pseudonyme : seulement des lettres, chiffres, espaces et . _ @ + -, en commençant par une lettre ou un chiffre</translation>
        </message>
        <message>
            <source>{pseudonym!r} looks like a key of this program: choose another pseudonym</source>
            <translation type="unfinished">{pseudonym!r} ressemble à une clé de ce programme : choisissez un autre pseudonyme</translation>
        </message>
        <message>
            <source>{pseudonym!r} stands there twice: delete one row</source>
            <translation type="unfinished">{pseudonym!r} y figure deux fois : supprimez une ligne</translation>
        </message>
        <message>
            <source>the cameras see the needle again: the depth is measured</source>
            <translation type="unfinished">les caméras voient de nouveau l’aiguille : la profondeur est mesurée</translation>
        </message>
        <message>
            <source>the cameras have not seen the needle for {tracker_hold:.0f} ms</source>
            <translation type="unfinished">les caméras n’ont pas vu l’aiguille depuis {tracker_hold:.0f} ms</translation>
        </message>
        <message>
            <source>{reason}: from now on the depth is not measured, and the force is held back as if the needle could be anywhere</source>
            <translation type="unfinished">{reason} : désormais la profondeur n’est pas mesurée, et la force est limitée comme si l’aiguille pouvait être n’importe où</translation>
        </message>
        <message>
            <source>{refusal} while {attempt_state}: end the attempt first</source>
            <translation type="unfinished">{refusal} dans l’état {attempt_state} : terminez d’abord l’essai</translation>
        </message>
        <message>
            <source>a control scan is not possible while {attempt_state}: begin an attempt first</source>
            <translation type="unfinished">un scan de contrôle n’est pas possible dans l’état {attempt_state} : commencez d’abord un essai</translation>
        </message>
        <message>
            <source>no attempt has begun</source>
            <translation type="unfinished">aucun essai n’a commencé</translation>
        </message>
        <message>
            <source>{samples_file} does not begin with {magic}</source>
            <translation type="unfinished">{samples_file} ne commence pas par {magic}</translation>
        </message>
        <message>
            <source>{samples_file} has version {version}, not {known_version}</source>
            <translation type="unfinished">{samples_file} a la version {version}, et non {known_version}</translation>
        </message>
        <message>
            <source>{samples_file} is damaged: its checksum is another</source>
            <translation type="unfinished">{samples_file} est endommagé : sa somme de contrôle est différente</translation>
        </message>
        <message>
            <source>{samples_file} cannot be read: {error}</source>
            <translation type="unfinished">{samples_file} ne peut pas être lu : {error}</translation>
        </message>
        <message>
            <source>{rows} rows of {columns} columns in {block_bytes} bytes</source>
            <translation type="unfinished">lignes : {rows}, colonnes : {columns}, en {block_bytes} octets</translation>
        </message>
        <message>
            <source>it lacks {missing}</source>
            <translation type="unfinished">il manque {missing}</translation>
        </message>
        <message>
            <source>a word of more than {longest_word} characters</source>
            <translation type="unfinished">un mot de plus de {longest_word} caractères</translation>
        </message>
        <message>
            <source>a record in it is cut off</source>
            <translation type="unfinished">un bloc de données y est coupé</translation>
        </message>
        <message>
            <source>a chunk is compressed by {chunk_compression!r}, not zstd</source>
            <translation type="unfinished">un segment est compressé par {chunk_compression!r}, et non par zstd</translation>
        </message>
        <message>
            <source>a chunk does not hold the {size} bytes that it says</source>
            <translation type="unfinished">un segment ne contient pas les {size} octets qu’il annonce</translation>
        </message>
        <message>
            <source>its crc is another</source>
            <translation type="unfinished">son CRC est différent</translation>
        </message>
        <message>
            <source>{path_name} is not an MCAP file: it begins with {first_bytes}</source>
            <translation type="unfinished">{path_name} n’est pas un fichier MCAP : il commence par {first_bytes}</translation>
        </message>
        <message>
            <source>the record at byte {offset} is damaged and left out: {fault}</source>
            <translation type="unfinished">le bloc de données à l’octet {offset} est endommagé et omis : {fault}</translation>
        </message>
        <message>
            <source>no sample of this attempt has a direction of the needle</source>
            <translation type="unfinished">aucun échantillon de cet essai n’a de direction de l’aiguille</translation>
        </message>
        <message>
            <source>depth not measured{reason}</source>
            <translation type="unfinished">profondeur non mesurée{reason}</translation>
        </message>
        <message>
            <source>depth not measured{reason}: it may be anywhere from {low:.0f} to {high:.0f} mm, and the force is held back for the worst of it</source>
            <translation type="unfinished">profondeur non mesurée{reason} : elle peut être n’importe où de {low:.0f} à {high:.0f} mm, et la force est limitée pour le pire cas</translation>
        </message>
        <message>
            <source>the needle bends: its tip is {pose_deflection:.1f} mm off its line</source>
            <translation type="unfinished">l’aiguille fléchit : sa pointe est à {pose_deflection:.1f} mm de son axe</translation>
        </message>
        <message>
            <source>depth from one camera and the needle's line: less exact</source>
            <translation type="unfinished">profondeur d’après une caméra et l’axe de l’aiguille : moins précise</translation>
        </message>
        <message>
            <source>depth held for {pose_depth_age:.0f} ms</source>
            <translation type="unfinished">profondeur maintenue depuis {pose_depth_age:.0f} ms</translation>
        </message>
        <message>
            <source>{recording_lost_rows} ticks of the loop were not recorded</source>
            <translation type="unfinished">cycles de la boucle de commande non enregistrés : {recording_lost_rows}</translation>
        </message>
        <message>
            <source>the station's key {path} cannot be used: {error_strerror}; attempts stay unsigned until it can be read</source>
            <translation type="unfinished">la clé {path} du poste est inutilisable : {error_strerror} ; les essais restent non signés tant qu’elle ne peut pas être lue</translation>
        </message>
        <message>
            <source>the station's key {path} is damaged: bring it back with `acus store restore` and the recovery key, or move it away for a new one</source>
            <translation type="unfinished">la clé {path} du poste est endommagée : reprenez-la avec `acus store restore` et la clé de récupération, ou mettez-la de côté pour en avoir une nouvelle</translation>
        </message>
        <message>
            <source>the station's key in this backup was sealed by an earlier build, in a form that is no longer read: change the password where it was made (`acus people instructor`), which prints a new recovery key, and make the backup again; or restore it without `--key`, and admit its attempts</source>
            <translation type="unfinished">la clé du poste dans cette sauvegarde a été scellée par une version antérieure, sous une forme qui n’est plus lue : changez le mot de passe là où elle a été faite (`acus people instructor`), ce qui imprime une nouvelle clé de récupération, et refaites la sauvegarde ; ou restaurez-la sans `--key`, et admettez ses essais</translation>
        </message>
        <message>
            <source>a nonce of {nonce_bytes} bytes</source>
            <translation type="unfinished">un nonce de {nonce_bytes} octets</translation>
        </message>
        <message>
            <source>the station's key in this backup is damaged</source>
            <translation type="unfinished">la clé du poste dans cette sauvegarde est endommagée</translation>
        </message>
        <message>
            <source>that is not the recovery key that was printed: type it again</source>
            <translation type="unfinished">ce n’est pas la clé de récupération imprimée : saisissez-la de nouveau</translation>
        </message>
        <message>
            <source>a recovery key has eight groups of four letters and digits: type it again</source>
            <translation type="unfinished">une clé de récupération a huit groupes de quatre lettres et chiffres : saisissez-la de nouveau</translation>
        </message>
        <message>
            <source>{session_id!r} {trouble} in {folder}: `acus session list` says which there are</source>
            <translation type="unfinished">{session_id!r} {trouble} dans {folder} : `acus session list` indique ceux qui existent</translation>
        </message>
        <message>
            <source>{folder} holds {count} records: give the file of one of them</source>
            <translation type="unfinished">enregistrements dans {folder} : {count} ; indiquez le fichier de l’un d’eux</translation>
        </message>
        <message>
            <source>{path_stem} is being recorded: end its attempt first, or wait 10 s</source>
            <translation type="unfinished">{path_stem} est en cours d’enregistrement : terminez d’abord son essai, ou attendez 10 s</translation>
        </message>
        <message>
            <source>{chosen} is not a folder: give the folder that holds the records</source>
            <translation type="unfinished">{chosen} n’est pas un dossier : indiquez le dossier qui contient les enregistrements</translation>
        </message>
        <message>
            <source>cannot read the folder {folder}: {error_strerror}</source>
            <translation type="unfinished">impossible de lire le dossier {folder} : {error_strerror}</translation>
        </message>
        <message>
            <source>{target} exists already: move it away first</source>
            <translation type="unfinished">{target} existe déjà : déplacez-le d’abord</translation>
        </message>
        <message>
            <source>cannot move {path} to {to}: {reason}</source>
            <translation type="unfinished">impossible de déplacer {path} vers {to} : {reason}</translation>
        </message>
        <message>
            <source>version {version!r}; only {known_version} is known</source>
            <translation type="unfinished">version {version!r} ; seule {known_version} est connue</translation>
        </message>
        <message>
            <source>not a stored score</source>
            <translation type="unfinished">ce n’est pas une note enregistrée</translation>
        </message>
        <message>
            <source>this computer was too slow by {seconds:.0f} s: robot, cameras and hand were slowed with it, and the score is what it would have been</source>
            <translation type="unfinished">cet ordinateur a été trop lent de {seconds:.0f} s : le robot, les caméras et la main ont été ralentis d’autant, et la note est celle qu’elle aurait été</translation>
        </message>
        <message>
            <source>the computer or the program slept for {seconds:.1f} s: what the needle did meanwhile is not known</source>
            <translation type="unfinished">l’ordinateur ou le programme s’est endormi pendant {seconds:.1f} s : on ne sait pas ce que l’aiguille a fait entre-temps</translation>
        </message>
        <message>
            <source>no slot {name!r} in this record; it has {columns}</source>
            <translation type="unfinished">pas d’emplacement {name!r} dans cet enregistrement ; il a {columns}</translation>
        </message>
        <message>
            <source>only {usable} of {seen} fixes could be used, {fewest} are needed: keep the marker in both pictures and hold still</source>
            <translation type="unfinished">seules {usable} mesures sur {seen} étaient utilisables, il en faut {fewest} : gardez le marqueur dans les deux images et ne bougez pas</translation>
        </message>
        <message>
            <source>the tip moved by {spread_mm:.1f} mm while it was measured: rest it in the mark and hold still for a second</source>
            <translation type="unfinished">la pointe a bougé de {spread_mm:.1f} mm pendant la mesure : posez-la dans le repère et ne bougez plus pendant une seconde</translation>
        </message>
        <message>
            <source>nobody can take the needle over while {running_attempt_state}: no attempt is running</source>
            <translation type="unfinished">personne ne peut prendre l’aiguille dans l’état {running_attempt_state} : aucun essai n’est en cours</translation>
        </message>
        <message>
            <source>exercise {exercise_id} keeps the assistance at {dial:g}; it can be turned in exercises that do not lock it</source>
            <translation type="unfinished">l’exercice {exercise_id} maintient l’assistance à {dial:g} ; on peut la régler dans les exercices qui ne la verrouillent pas</translation>
        </message>
        <message>
            <source>exercise {exercise_id} keeps the models by which its effects are computed; they can be chosen in exercises that do not lock them</source>
            <translation type="unfinished">l’exercice {exercise_id} garde les modèles par lesquels ses effets sont calculés ; on peut les choisir dans les exercices qui ne les verrouillent pas</translation>
        </message>
        <message>
            <source>the patient of exercise {exercise_id} does not hold the breath on command; breathing with `model: on_command` does</source>
            <translation type="unfinished">le patient de l’exercice {exercise_id} ne retient pas sa respiration sur ordre ; une respiration avec `model: on_command` le fait</translation>
        </message>
        <message>
            <source>pseudonym or PIN is wrong</source>
            <translation type="unfinished">le pseudonyme ou le code PIN est faux</translation>
        </message>
        <message>
            <source>{error}; until then wrong tries are not kept</source>
            <translation type="unfinished">{error} ; d’ici là, les tentatives erronées ne sont pas conservées</translation>
        </message>
        <message>
            <source>too many wrong tries: wait {early:.0f} s, then try again</source>
            <translation type="unfinished">trop de tentatives erronées : attendez {early:.0f} s, puis réessayez</translation>
        </message>
        <message>
            <source>: wait {wait:.0f} s before the next try</source>
            <translation type="unfinished">: attendez {wait:.0f} s avant la prochaine tentative</translation>
        </message>
        <message>
            <source>the password is wrong</source>
            <translation type="unfinished">le mot de passe est faux</translation>
        </message>
        <message>
            <source>{quantity}: {written} written, {recomputed} by the record</source>
            <translation type="unfinished">{quantity} : {written} écrit, {recomputed} d’après l’enregistrement</translation>
        </message>
        <message>
            <source>the score cannot be computed again: not all samples are in the record</source>
            <translation type="unfinished">la note ne peut pas être recalculée : tous les échantillons ne sont pas dans l’enregistrement</translation>
        </message>
        <message>
            <source>scored by version {written_version}: {points}, by today's rules: {now}</source>
            <translation type="unfinished">noté d’après la version {written_version} : {points}, d’après les règles d’aujourd’hui : {now}</translation>
        </message>
        <message>
            <source>the score in this record is not what its samples give: {most}{more}</source>
            <translation type="unfinished">la note de cet enregistrement n’est pas celle que donnent ses échantillons : {most}{more}</translation>
        </message>
        <message>
            <source>the attempt was not finished: it has no score to verify</source>
            <translation type="unfinished">l’essai n’a pas été terminé : il n’y a pas de note à vérifier</translation>
        </message>
        <message>
            <source>this program has the rules of versions {versions}</source>
            <translation type="unfinished">ce programme a les règles des versions {versions}</translation>
        </message>
        <message>
            <source>it cannot be checked: {known}</source>
            <translation type="unfinished">elle ne peut pas être vérifiée : {known}</translation>
        </message>
        <message>
            <source>not scored, as written: {unscored}</source>
            <translation type="unfinished">sans note, comme écrit : {unscored}</translation>
        </message>
        <message>
            <source>the cameras saw the tip {pose_depth_mm:.0f} mm inside the skin {now:.1f} s after you said that the needle is out; withdraw it and begin again</source>
            <translation type="unfinished">les caméras ont vu la pointe à {pose_depth_mm:.0f} mm sous la peau {now:.1f} s après que vous avez dit que l’aiguille est sortie ; retirez-la complètement et recommencez</translation>
        </message>
        <message>
            <source>the field has {tissues} tissues and {rows} rows of values; give one for each code</source>
            <translation type="unfinished">le champ a {tissues} tissus et {rows} lignes de valeurs ; donnez-en une pour chaque code</translation>
        </message>
        <message>
            <source>device {name!r} renders {unknown_axis!r}; known axes are {device_axes}</source>
            <translation type="unfinished">l’appareil {name!r} rend {unknown_axis!r} ; les axes connus sont {device_axes}</translation>
        </message>
        <message>
            <source>effect {name!r} has no model {asked!r}; it has {models}</source>
            <translation type="unfinished">l’effet {name!r} n’a pas de modèle {asked!r} ; il a {models}</translation>
        </message>
        <message>
            <source>{declared_path}: parameters() gives an array of the shape {array_shape} for this scene and these values; give one of the shape (n,), and of {least} numbers at least, as it was tried</source>
            <translation type="unfinished">{declared_path} : parameters() donne pour cette scène et ces valeurs un tableau de forme {array_shape} ; donnez-en un de forme (n,) et d’au moins {least} nombres, tel qu’il a été essayé</translation>
        </message>
        <message>
            <source>{effect_path}: step is not compiled; put @stage of core.compiled before it</source>
            <translation type="unfinished">{effect_path} : step n’est pas compilé ; placez devant @stage de core.compiled</translation>
        </message>
        <message>
            <source>{effect_path}: pictures is True; only the program's own effects act on pictures</source>
            <translation type="unfinished">{effect_path} : pictures vaut True ; seuls les effets du programme lui-même agissent sur les images</translation>
        </message>
        <message>
            <source>joint {joint!r} is none of the two that are known ({names}); it is taken as redesigned: give design 1 for printed, or 2</source>
            <translation type="unfinished">l’articulation {joint!r} n’est aucune des deux connues ({names}) ; elle est considérée comme reconçue : donnez design 1 pour imprimée, ou 2</translation>
        </message>
        <message>
            <source>the robot's own joints are felt beside it</source>
            <translation type="unfinished">les articulations propres du robot se sentent en plus</translation>
        </message>
        <message>
            <source>model {binding_model} changes sign with every encoder count, a tilt of {count:g} mrad; kikuuwe does not</source>
            <translation type="unfinished">le modèle {binding_model} change de signe à chaque pas du codeur, soit une inclinaison de {count:g} mrad ; kikuuwe, non</translation>
        </message>
        <message>
            <source>presliding_angle {presliding_angle:g} rad is less than an encoder count of {count:g} rad: a still hand feels the force change sign; give {count:g} rad or more</source>
            <translation type="unfinished">presliding_angle {presliding_angle:g} rad est inférieur à un pas du codeur de {count:g} rad : une main immobile sent la force changer de signe ; donnez {count:g} rad ou plus</translation>
        </message>
        <message>
            <source>the layers are {thickness:g} m thick together; at most {longest:g} m</source>
            <translation type="unfinished">les couches ont ensemble une épaisseur de {thickness:g} m ; {longest:g} m au plus</translation>
        </message>
        <message>
            <source>puncture by rate relaxes its dimple itself: this adds to the force that a membrane tears at; take the model standing</source>
            <translation type="unfinished">puncture par rate relâche lui-même son enfoncement : ceci s’ajoute à la force à laquelle une membrane se déchire ; prenez le modèle standing</translation>
        </message>
        <message>
            <source>the dimple does not relax: puncture by rate would, and its model is another</source>
            <translation type="unfinished">l’enfoncement ne se relâche pas : puncture par rate le ferait, mais son modèle est autre</translation>
        </message>
        <message>
            <source>model {binding_model} changes sign with every count of a measured depth, here {count:g} µm; kikuuwe does not</source>
            <translation type="unfinished">le modèle {binding_model} change de signe à chaque pas d’une profondeur mesurée, ici {count:g} µm ; kikuuwe, non</translation>
        </message>
        <message>
            <source>presliding_stiffness {presliding_stiffness:g} N/m² times a count of {count:g} µm is more than the friction of {friction:g} N/m: a still hand feels it change sign with every count; give {largest_stiffness:g} N/m² or less</source>
            <translation type="unfinished">presliding_stiffness {presliding_stiffness:g} N/m² multiplié par un pas de {count:g} µm dépasse le frottement de {friction:g} N/m : une main immobile le sent changer de signe à chaque pas ; donnez {largest_stiffness:g} N/m² ou moins</translation>
        </message>
        <message>
            <source>the scene's field is a {type_name}; bind it first</source>
            <translation type="unfinished">le champ de la scène est un {type_name} ; liez-le d’abord</translation>
        </message>
        <message>
            <source>there is no hand {name!r}; there are {hands}</source>
            <translation type="unfinished">il n’y a pas de main {name!r} ; il existe {hands}</translation>
        </message>
        <message>
            <source>the target lies at depth {depth} m; it must be above 0</source>
            <translation type="unfinished">la cible est à la profondeur {depth} m ; elle doit être supérieure à 0</translation>
        </message>
        <message>
            <source>effect {stored_name}: energy_bound is {bound} J; give a finite number of 0 or more</source>
            <translation type="unfinished">effet {stored_name} : energy_bound vaut {bound} J ; donnez un nombre fini d’au moins 0</translation>
        </message>
        <message>
            <source>dropped: it needs {need}, and the scene has none</source>
            <translation type="unfinished">écarté : il demande {need}, et la scène n’en a pas</translation>
        </message>
        <message>
            <source>dropped: it acts on {request_organ}, and the target lies in {scene_target_organ}</source>
            <translation type="unfinished">écarté : il agit sur {request_organ}, et la cible se trouve dans {scene_target_organ}</translation>
        </message>
        <message>
            <source>effect {name} builds on it</source>
            <translation type="unfinished">l’effet {name} s’appuie dessus</translation>
        </message>
        <message>
            <source>simulated: it gives {in_words}; {consumers}</source>
            <translation type="unfinished">simulé : il donne {in_words} ; {consumers}</translation>
        </message>
        <message>
            <source>dropped: it changes the pictures of simulated cameras, and there are none: the cameras are real, and so are their pictures</source>
            <translation type="unfinished">écarté : il modifie les images de caméras simulées, et il n’y en a pas : les caméras sont réelles, et leurs images aussi</translation>
        </message>
        <message>
            <source>dropped: it gives {in_words}, and nobody asks for that: device {device_name} renders {axes} force, and no view that is shown, no metric that is scored and no other effect needs it</source>
            <translation type="unfinished">écarté : il donne {in_words}, et personne ne le demande : l’appareil {device_name} rend la force pour : {axes}, et aucune vue affichée, aucun indicateur noté ni aucun autre effet n’en a besoin</translation>
        </message>
        <message>
            <source>nothing but its own account</source>
            <translation type="unfinished">rien que son propre bilan</translation>
        </message>
        <message>
            <source>effects need each other's results in a circle: {circle}; take one of them out</source>
            <translation type="unfinished">des effets ont besoin en boucle des résultats les uns des autres : {circle} ; retirez-en un</translation>
        </message>
        <message>
            <source>hand {name} is {setting}; give a finite value of 0 or more</source>
            <translation type="unfinished">main : {name} vaut {setting} ; donnez une valeur finie d’au moins 0</translation>
        </message>
        <message>
            <source>device {profile_name} cannot hold the needle along {direction}; its tilt limit is {profile_tilt_limit_deg:g} degrees</source>
            <translation type="unfinished">l’appareil {profile_name} ne peut pas tenir l’aiguille dans la direction {direction} ; sa limite d’inclinaison est de {profile_tilt_limit_deg:g} degrés</translation>
        </message>
        <message>
            <source>layer {name!r}: {quantity} is {setting}; give a finite value of 0 or more</source>
            <translation type="unfinished">couche {name!r} : {quantity} vaut {setting} ; donnez une valeur finie d’au moins 0</translation>
        </message>
        <message>
            <source>layer {name!r}: moves is {moves}; give a share from 0 to 1, or leave it out</source>
            <translation type="unfinished">couche {name!r} : moves vaut {moves} ; donnez une part de 0 à 1, ou omettez-le</translation>
        </message>
        <message>
            <source>layer {name!r}: relaxation_share is {relaxation_share} and relaxation_time {relaxation_time}; give 0 to below 1, and above 0 s</source>
            <translation type="unfinished">couche {name!r} : relaxation_share vaut {relaxation_share} et relaxation_time {relaxation_time} ; donnez de 0 à moins de 1, et plus de 0 s</translation>
        </message>
        <message>
            <source>layer {name!r}: a membrane that is punctured at {puncture_force} N needs an indentation_stiffness or indentation_hardening above 0</source>
            <translation type="unfinished">couche {name!r} : une membrane perforée à {puncture_force} N demande un indentation_stiffness ou un indentation_hardening supérieur à 0</translation>
        </message>
        <message>
            <source>layer {below_name!r} lies below {above_name!r}, which is rigid: the needle stops there; let the rigid layer be the last one</source>
            <translation type="unfinished">la couche {below_name!r} se trouve sous {above_name!r}, qui est rigide : l’aiguille s’y arrête ; placez la couche rigide en dernier</translation>
        </message>
        <message>
            <source>layer 'skin' lies below {above_name!r}; layers are given from the skin inwards</source>
            <translation type="unfinished">la couche 'skin' se trouve sous {above_name!r} ; les couches se donnent de la peau vers l’intérieur</translation>
        </message>
        <message>
            <source>needle {quantity} is {setting}; give a finite value above 0</source>
            <translation type="unfinished">aiguille : {quantity} vaut {setting} ; donnez une valeur finie supérieure à 0</translation>
        </message>
        <message>
            <source>R_world_patient {rotation} is not a rotation</source>
            <translation type="unfinished">R_world_patient {rotation} n’est pas une rotation</translation>
        </message>
        <message>
            <source>the scene has a field of tissue and no values for it; give a row of `tissues` for each of its codes, the first for what nobody labelled</source>
            <translation type="unfinished">la scène a un champ de tissus sans valeurs ; donnez une ligne de `tissues` pour chacun de ses codes, la première pour ce que personne n’a étiqueté</translation>
        </message>
        <message>
            <source>effect {effect_name!r} stands twice in the scene; name it once</source>
            <translation type="unfinished">l’effet {effect_name!r} figure deux fois dans la scène ; nommez-le une fois</translation>
        </message>
        <message>
            <source>there is no skill {skill!r}; there are {skills}</source>
            <translation type="unfinished">il n’y a pas de degré d’habileté {skill!r} ; il existe {skills}</translation>
        </message>
        <message>
            <source>there are no values of tissues called {version!r}; there are {tissues}</source>
            <translation type="unfinished">aucune valeur de tissus ne s’appelle {version!r} ; il existe {tissues}</translation>
        </message>
        <message>
            <source>the {version} values have no tissue {name!r}; they have {table}</source>
            <translation type="unfinished">les valeurs {version} n’ont pas de tissu {name!r} ; elles ont {table}</translation>
        </message>
        <message>
            <source>targets to be touched lie {depths} m deep; each must lie deeper than their radius of {radius} m</source>
            <translation type="unfinished">les cibles à toucher sont à {depths} m de profondeur ; chacune doit être plus profonde que son rayon de {radius} m</translation>
        </message>
        <message>
            <source>speed factor is {speed}; give 0.05 to 20</source>
            <translation type="unfinished">le facteur de vitesse est {speed} ; donnez de 0,05 à 20</translation>
        </message>
        <message>
            <source>a movement to be shown needs two finite samples at least</source>
            <translation type="unfinished">un mouvement à montrer demande au moins deux échantillons finis</translation>
        </message>
        <message>
            <source>{file} cannot be written, so that what is tried would be lost: {error}</source>
            <translation type="unfinished">{file} ne peut pas être écrit, de sorte que ce qui est essayé serait perdu : {error}</translation>
        </message>
        <message>
            <source>{label}: {current} of {evaluations}, {holes} holes</source>
            <translation type="unfinished">{label} : {current} sur {evaluations}, failles : {holes}</translation>
        </message>
        <message>
            <source>n = {shape:g} is no whole number: the sum has no end</source>
            <translation type="unfinished">n = {shape:g} n’est pas un nombre entier : la somme n’a pas de fin</translation>
        </message>
        <message>
            <source>squares of {square:g} px</source>
            <translation type="unfinished">cases de {square:g} px</translation>
        </message>
        <message>
            <source>SimpleITK, which this study needs,</source>
            <translation type="unfinished">SimpleITK, dont cette étude a besoin,</translation>
        </message>
        <message>
            <source>no element can be read</source>
            <translation type="unfinished">aucun élément ne peut être lu</translation>
        </message>
        <message>
            <source>table {name}: two of its headings are alike: {columns}</source>
            <translation type="unfinished">tableau {name} : deux de ses titres sont identiques : {columns}</translation>
        </message>
        <message>
            <source>table {name}: a row has {cells} cells, there are {headings} headings: {row}</source>
            <translation type="unfinished">tableau {name} : une ligne a {cells} cellules, il y a {headings} titres : {row}</translation>
        </message>
        <message>
            <source>this survey has no measure=...; see 'How to add a study'</source>
            <translation type="unfinished">cette enquête n’a pas de measure=... ; voir « How to add a study »</translation>
        </message>
        <message>
            <source>two hard cases are called {case_name!r}; rename one</source>
            <translation type="unfinished">deux cas difficiles s’appellent {case_name!r} ; renommez-en un</translation>
        </message>
        <message>
            <source>subsystems without a hard case: {bare}</source>
            <translation type="unfinished">sous-systèmes sans cas difficile : {bare}</translation>
        </message>
        <message>
            <source>{references} has no reference {name!r}; add it to tools/hard_references.py</source>
            <translation type="unfinished">{references} n’a pas de référence {name!r} ; ajoutez-la dans tools/hard_references.py</translation>
        </message>
        <message>
            <source>hard case {case!r}: subsystem is {subsystem!r}; there are {subsystems}</source>
            <translation type="unfinished">cas difficile {case!r} : subsystem vaut {subsystem!r} ; il existe {subsystems}</translation>
        </message>
        <message>
            <source>hard case {case!r} has no reference; use digits() or analytic()</source>
            <translation type="unfinished">le cas difficile {case!r} n’a pas de référence ; utilisez digits() ou analytic()</translation>
        </message>
        <message>
            <source>hard case {case!r}: bound is {bound}; give 0 or more</source>
            <translation type="unfinished">cas difficile {case!r} : bound vaut {bound} ; donnez 0 ou plus</translation>
        </message>
        <message>
            <source>hard case {case!r}: {name} is empty; say it in words</source>
            <translation type="unfinished">cas difficile {case!r} : {name} est vide ; dites-le en mots</translation>
        </message>
        <message>
            <source>hard case {case!r}: {computed} values found, the reference has {expected}</source>
            <translation type="unfinished">cas difficile {case!r} : {computed} valeurs trouvées, la référence en a {expected}</translation>
        </message>
        <message>
            <source>{function_qualname} does not call {name}</source>
            <translation type="unfinished">{function_qualname} n’appelle pas {name}</translation>
        </message>
        <message>
            <source>{caller!r} has no default for {parameter}</source>
            <translation type="unfinished">{caller!r} n’a pas de valeur par défaut pour {parameter}</translation>
        </message>
        <message>
            <source>no table of study {name!r} is kept; there are {names}</source>
            <translation type="unfinished">aucun tableau de l’étude {name!r} n’est conservé ; il existe {names}</translation>
        </message>
        <message>
            <source>{path} is no table of a study ({error_name}: {error}); write it anew with: acus study NAME --write</source>
            <translation type="unfinished">{path} n’est pas un tableau d’étude ({error_name} : {error}) ; récrivez-le avec : acus study NAME --write</translation>
        </message>
        <message>
            <source>a kept table cannot be measured again; run the study of its name</source>
            <translation type="unfinished">un tableau conservé ne peut pas être mesuré de nouveau ; lancez l’étude de ce nom</translation>
        </message>
        <message>
            <source>a beam needs k &gt; 0, EI &gt; 0 and depth &gt;= 0; given k = {k}, EI = {ei}, depth = {depth}</source>
            <translation type="unfinished">une poutre demande k &gt; 0, EI &gt; 0 et depth &gt;= 0 ; reçu k = {k}, EI = {ei}, depth = {depth}</translation>
        </message>
        <message>
            <source>{name}, {depth:g} mm</source>
            <translation type="unfinished">{name}, {depth:g} mm</translation>
        </message>
        <message>
            <source>limits of {name}</source>
            <translation type="unfinished">limites : {name}</translation>
        </message>
        <message>
            <source>unreachable: the ball joint stops at {profile_tilt_limit_deg:g}° of tilt</source>
            <translation type="unfinished">inaccessible : la rotule s’arrête à {profile_tilt_limit_deg:g}° d’inclinaison</translation>
        </message>
        <message>
            <source>reach and cost</source>
            <translation type="unfinished">portée et coût</translation>
        </message>
        <message>
            <source>by tilt</source>
            <translation type="unfinished">selon l’inclinaison</translation>
        </message>
        <message>
            <source>camera {model_name} has no picture of a band at {p_camera} m</source>
            <translation type="unfinished">la caméra {model_name} n’a pas d’image d’une bande à {p_camera} m</translation>
        </message>
        <message>
            <source>camera {model_name} does not see the band at {scene_p_world}</source>
            <translation type="unfinished">la caméra {model_name} ne voit pas la bande à {scene_p_world}</translation>
        </message>
        <message>
            <source>cube of {edge_mm:g} mm</source>
            <translation type="unfinished">cube de {edge_mm:g} mm</translation>
        </message>
        <message>
            <source>trials</source>
            <translation type="unfinished">tirages</translation>
        </message>
        <message>
            <source>cannot write the picture {path}: {error}</source>
            <translation type="unfinished">impossible d’écrire l’image {path} : {error}</translation>
        </message>
        <message>
            <source>{path} has no list `cases`</source>
            <translation type="unfinished">{path} n’a pas de liste `cases`</translation>
        </message>
        <message>
            <source>{path}: two cases are called {case_name!r}; rename one</source>
            <translation type="unfinished">{path} : deux cas s’appellent {case_name!r} ; renommez-en un</translation>
        </message>
        <message>
            <source>{where} is {row!r}; give {wanted}</source>
            <translation type="unfinished">{where} vaut {row!r} ; donnez {wanted}</translation>
        </message>
        <message>
            <source>{where}: check {key!r}; there must be {wanted}, and may be {may}</source>
            <translation type="unfinished">{where} : vérifiez {key!r} ; il doit y avoir {wanted}, et il peut y avoir {may}</translation>
        </message>
        <message>
            <source>{where}: {key} is {row!r}</source>
            <translation type="unfinished">{where} : {key} vaut {row!r}</translation>
        </message>
        <message>
            <source>{where}: range is {ends!r}; give [least, most], finite numbers</source>
            <translation type="unfinished">{where} : range vaut {ends!r} ; donnez [minimum, maximum], des nombres finis</translation>
        </message>
        <message>
            <source>{where}: {measured:g} {unit} was measured, and the range {least:g} to {largest:g} excludes it; give the range that holds it</source>
            <translation type="unfinished">{where} : {measured:g} {unit} ont été mesurés, et la plage de {least:g} à {largest:g} les exclut ; donnez la plage qui les contient</translation>
        </message>
        <message>
            <source>{where}: {quantity} is {entry!r}; there are {valid}</source>
            <translation type="unfinished">{where} : {quantity} vaut {entry!r} ; il existe {valid}</translation>
        </message>
        <message>
            <source>{where} is not chosen; say in `choice` why</source>
            <translation type="unfinished">{where} n’est pas choisi ; dites pourquoi dans `choice`</translation>
        </message>
        <message>
            <source>device {profile_name}: tool_mass is {profile_inertia_tool_mass} kg; MuJoCo needs a positive one</source>
            <translation type="unfinished">appareil {profile_name} : tool_mass vaut {profile_inertia_tool_mass} kg ; MuJoCo demande une masse positive</translation>
        </message>
        <message>
            <source>MuJoCo refuses the model of device {profile_name}: {error}</source>
            <translation type="unfinished">MuJoCo refuse le modèle de l’appareil {profile_name} : {error}</translation>
        </message>
        <message>
            <source>MuJoCo's model of {profile_name} still moves at {speed:.2g} rad/s after 0.4 s; the torques {torques} N·m may be too large</source>
            <translation type="unfinished">le modèle MuJoCo de {profile_name} bouge encore à {speed:.2g} rad/s après 0,4 s ; les couples {torques} N·m sont peut-être trop grands</translation>
        </message>
        <message>
            <source>tilt is {tilt} rad; a cone needs more than 0 and less than π/2</source>
            <translation type="unfinished">l’inclinaison est de {tilt} rad ; un cône demande plus de 0 et moins de π/2</translation>
        </message>
        <message>
            <source>no tool point within {tilt_deg:g}° of tilt is reached in mode {mode}, assembly {assembly}</source>
            <translation type="unfinished">aucun point d’outil à moins de {tilt_deg:g}° d’inclinaison n’est atteint en mode {mode}, assemblage {assembly}</translation>
        </message>
        <message>
            <source>L_out is {l_out} m and tilt {tilt} rad; L_out must be above 0, tilt in [0, π/2)</source>
            <translation type="unfinished">L_out est de {l_out} m et l’inclinaison de {tilt} rad ; L_out doit être supérieur à 0, l’inclinaison dans [0, π/2)</translation>
        </message>
        <message>
            <source>study file {declared_path} must define STUDY, a Study or Survey of {name!r}</source>
            <translation type="unfinished">le fichier d’étude {declared_path} doit définir STUDY, une Study ou Survey nommée {name!r}</translation>
        </message>
        <message>
            <source>study {chosen_name} has no ways to time; examine() runs a survey</source>
            <translation type="unfinished">l’étude {chosen_name} n’a pas de méthodes à chronométrer ; examine() exécute une enquête</translation>
        </message>
        <message>
            <source>{name}: {name_of_all}</source>
            <translation type="unfinished">{name} : {name_of_all}</translation>
        </message>
        <message>
            <source>study {chosen_name} compares ways by time; run() runs it</source>
            <translation type="unfinished">l’étude {chosen_name} compare des méthodes selon leur durée ; run() l’exécute</translation>
        </message>
        <message>
            <source>study {chosen_name} takes no folders; leave {folder} out</source>
            <translation type="unfinished">l’étude {chosen_name} ne prend pas de dossiers ; omettez {folder}</translation>
        </message>
        <message>
            <source>study {chosen_name} needs {chosen_borrows} from a room above; run it by: acus study {chosen_name}</source>
            <translation type="unfinished">l’étude {chosen_name} a besoin de {chosen_borrows} d’une salle supérieure ; lancez-la par : acus study {chosen_name}</translation>
        </message>
        <message>
            <source>its result is not finite (error {error})</source>
            <translation type="unfinished">son résultat n’est pas fini (erreur {error})</translation>
        </message>
        <message>
            <source>{rate:g} Hz, {delay} ticks</source>
            <translation type="unfinished">{rate:g} Hz, retard en cycles : {delay}</translation>
        </message>
        <message>
            <source>no ray of camera {model_name} for {pixels}</source>
            <translation type="unfinished">aucun rayon de la caméra {model_name} pour {pixels}</translation>
        </message>
        <message>
            <source>study {name}: each {kind} needs a name of its own: {names}</source>
            <translation type="unfinished">étude {name} : chaque élément ({kind}) demande un nom à lui : {names}</translation>
        </message>
        <message>
            <source>study {name}: its default {default!r} is no way; there are {ways}</source>
            <translation type="unfinished">étude {name} : son choix par défaut {default!r} n’est pas une méthode ; il existe {ways}</translation>
        </message>
        <message>
            <source>{picture} has {w}x{h} pixels; camera {camera_name} was calibrated at {cw}x{ch}: set the camera to that size, or calibrate at the new one</source>
            <translation type="unfinished">{picture} a {w}x{h} pixels ; la caméra {camera_name} a été étalonnée à {cw}x{ch} : réglez la caméra sur cette taille, ou refaites l’étalonnage à la nouvelle</translation>
        </message>
        <message>
            <source>the cameras are swapped: calibration {calibration_id} has {left_camera} on the left and {right_camera} on the right; exchange the two sources</source>
            <translation type="unfinished">les caméras sont inversées : l’étalonnage {calibration_id} a {left_camera} à gauche et {right_camera} à droite ; échangez les deux sources</translation>
        </message>
        <message>
            <source>calibration {calibration_id} is of the cameras {known}; in use are {names}: use their calibration, or calibrate them</source>
            <translation type="unfinished">l’étalonnage {calibration_id} est celui des caméras {known} ; celles en service sont {names} : utilisez leur étalonnage, ou étalonnez-les</translation>
        </message>
        <message>
            <source>no paper is called {name!r}; there are {papers}</source>
            <translation type="unfinished">aucun papier ne s’appelle {name!r} ; il existe {papers}</translation>
        </message>
        <message>
            <source>board {board_spec} measures {width:.0f} x {height:.0f} mm and does not fit on {paper_name}; squares of at most {largest_square:.4g} mm would</source>
            <translation type="unfinished">la mire {board_spec} mesure {width:.0f} x {height:.0f} mm et ne tient pas sur {paper_name} ; des carrés d’au plus {largest_square:.4g} mm tiendraient</translation>
        </message>
        <message>
            <source>, or take {others}</source>
            <translation type="unfinished">, ou prenez {others}</translation>
        </message>
        <message>
            <source>no picture shows the board: take one with all of it in view</source>
            <translation type="unfinished">aucune image ne montre la mire : prenez-en une où elle se voit tout entière</translation>
        </message>
        <message>
            <source>no place in front of the cameras explains the corners; are the pictures of these cameras, left and right not exchanged?</source>
            <translation type="unfinished">aucune position devant les caméras n’explique les coins ; les images viennent-elles bien de ces caméras, sans inversion de gauche et droite ?</translation>
        </message>
        <message>
            <source>checkerboard:COLSxROWS:SQUARE (inner corners, e.g. checkerboard:9x6:25mm) or charuco:COLSxROWS:SQUARE:MARKER:DICTIONARY (squares, e.g. {example})</source>
            <translation type="unfinished">checkerboard:COLSxROWS:SQUARE (coins intérieurs, p. ex. checkerboard:9x6:25mm) ou charuco:COLSxROWS:SQUARE:MARKER:DICTIONARY (carrés, p. ex. {example})</translation>
        </message>
        <message>
            <source>a board with {columns}x{rows} inner corners cannot be used; at least 2x2 and at most 100x100 are needed</source>
            <translation type="unfinished">une mire de {columns}x{rows} coins intérieurs est inutilisable ; il en faut au moins 2x2 et au plus 100x100</translation>
        </message>
        <message>
            <source>a square of {square:g} mm cannot be used; 0.1 mm to 1 m are possible</source>
            <translation type="unfinished">un carré de {square:g} mm est inutilisable ; de 0,1 mm à 1 m sont possibles</translation>
        </message>
        <message>
            <source>board {spec!r} is not {forms}</source>
            <translation type="unfinished">la mire {spec!r} n’est pas {forms}</translation>
        </message>
        <message>
            <source>no marker dictionary is called {board_dictionary!r}; there are {names}</source>
            <translation type="unfinished">aucun dictionnaire de marqueurs ne s’appelle {board_dictionary!r} ; il existe {names}</translation>
        </message>
        <message>
            <source>a marker of {board_marker:g} mm does not fit into a square of {board_square:g} mm; it must be smaller</source>
            <translation type="unfinished">un marqueur de {board_marker:g} mm ne tient pas dans un carré de {board_square:g} mm ; il doit être plus petit</translation>
        </message>
        <message>
            <source>board {board_spec} needs {needed} markers; {board_dictionary} has {dictionary_size}; take a larger dictionary</source>
            <translation type="unfinished">la mire {board_spec} demande {needed} marqueurs ; {board_dictionary} en a {dictionary_size} ; prenez un dictionnaire plus grand</translation>
        </message>
        <message>
            <source>board {spec!r}: {size!r} is not COLSxROWS, e.g. 9x6</source>
            <translation type="unfinished">mire {spec!r} : {size!r} n’est pas COLSxROWS, p. ex. 9x6</translation>
        </message>
        <message>
            <source>board {spec!r}: {length!r} is not a length with its unit; write e.g. 25mm, 2.5cm or 0.025m</source>
            <translation type="unfinished">mire {spec!r} : {length!r} n’est pas une longueur avec son unité ; écrivez p. ex. 25mm, 2.5cm ou 0.025m</translation>
        </message>
        <message>
            <source>the first estimate puts a board behind a camera</source>
            <translation type="unfinished">la première estimation place une mire derrière une caméra</translation>
        </message>
        <message>
            <source>adjusting</source>
            <translation type="unfinished">ajustement</translation>
        </message>
        <message>
            <source>{measured} pixel coordinates cannot determine {unknown} unknowns; add views</source>
            <translation type="unfinished">{measured} coordonnées de pixels ne peuvent pas déterminer {unknown} inconnues ; ajoutez des vues</translation>
        </message>
        <message>
            <source>the views do not determine where a board was; tilt the board to different sides by 20 to 45 degrees</source>
            <translation type="unfinished">les vues ne déterminent pas où était une mire ; inclinez la mire de 20 à 45 degrés vers différents côtés</translation>
        </message>
        <message>
            <source>{points} are {measured:.4g} mm apart, {known:.4g} mm known ({ratio:+.1%})</source>
            <translation type="unfinished">{points} sont distants de {measured:.4g} mm, pour {known:.4g} mm connus ({ratio:+.1%})</translation>
        </message>
        <message>
            <source>: more than {limit:.0%}; measure the board: squares of {fitting_mm:.4g} mm instead of {stated_mm:g} mm would explain it</source>
            <translation type="unfinished">: plus de {limit:.0%} ; mesurez la mire : des carrés de {fitting_mm:.4g} mm au lieu de {stated_mm:g} mm l’expliqueraient</translation>
        </message>
        <message>
            <source>hold the board nearer to the camera, and farther away</source>
            <translation type="unfinished">tenez la mire plus près de la caméra, puis plus loin</translation>
        </message>
        <message>
            <source>{count} more pictures of the board, unlike those taken</source>
            <translation type="unfinished">images de la mire à prendre encore, différentes des précédentes : {count}</translation>
        </message>
        <message>
            <source>{corner} corner of the picture not covered</source>
            <translation type="unfinished">coin de l’image non couvert : {corner}</translation>
        </message>
        <message>
            <source>, nothing near the {corner} corner</source>
            <translation type="unfinished">, rien près du coin : {corner}</translation>
        </message>
        <message>
            <source>{share} % of the picture covered, {wanted} % wanted{where}</source>
            <translation type="unfinished">{share} % de l’image couverts, {wanted} % souhaités{where}</translation>
        </message>
        <message>
            <source>tilt the board more: once its {first}, once its {second} side nearer</source>
            <translation type="unfinished">inclinez davantage la mire, tantôt ce côté plus près : {first}, tantôt celui-ci : {second}</translation>
        </message>
        <message>
            <source>tilt the board more: its {second} side towards the camera</source>
            <translation type="unfinished">inclinez davantage la mire, ce côté vers la caméra : {second}</translation>
        </message>
        <message>
            <source>tilt the board more: its {first} side towards the camera</source>
            <translation type="unfinished">inclinez davantage la mire, ce côté vers la caméra : {first}</translation>
        </message>
        <message>
            <source>{cameras} cameras were named; one or two can be calibrated</source>
            <translation type="unfinished">caméras nommées : {cameras} ; on peut en étalonner une ou deux</translation>
        </message>
        <message>
            <source>{pictures} pictures were given; there are {cameras} cameras: {names}</source>
            <translation type="unfinished">images données : {pictures} ; caméras : {cameras} ({names})</translation>
        </message>
        <message>
            <source>like one already kept: {next}</source>
            <translation type="unfinished">comme une image déjà gardée : {next}</translation>
        </message>
        <message>
            <source>hold the board still</source>
            <translation type="unfinished">ne bougez pas la mire</translation>
        </message>
        <message>
            <source>{names}: blurred, edges {view_sharpness:.1f} px wide (at most {limit:.1f}): more light, hold still, focus</source>
            <translation type="unfinished">{names} : flou, bords larges de {view_sharpness:.1f} px ({limit:.1f} au plus) : plus de lumière, ne bougez pas, faites la mise au point</translation>
        </message>
        <message>
            <source>there are enough views</source>
            <translation type="unfinished">il y a assez de vues</translation>
        </message>
        <message>
            <source>the board looks the same after half a turn (both corner counts odd, or both even), and the pairs do not tell which way round it lies ({scores:.1f} px one way, {second:.1f} px the other): take pictures of it in more places and tilts, or use a ChArUco board or one with an odd and an even count</source>
            <translation type="unfinished">la mire est identique après un demi-tour (nombres de coins tous deux impairs, ou tous deux pairs), et les paires ne disent pas dans quel sens elle est posée ({scores:.1f} px dans un sens, {second:.1f} px dans l’autre) : photographiez-la à plus d’endroits et d’inclinaisons, ou utilisez une mire ChArUco ou une mire avec un nombre impair et un nombre pair</translation>
        </message>
        <message>
            <source>an array of {image_dtype} and shape {shape} is no picture; 8 or 16 bit, grey or BGR, at least 16x16 pixels is needed</source>
            <translation type="unfinished">un tableau de type {image_dtype} et de forme {shape} n’est pas une image ; il faut 8 ou 16 bits, en gris ou BGR, au moins 16x16 pixels</translation>
        </message>
        <message>
            <source>no board with {board_columns}x{board_rows} inner corners is seen as a whole; show all of it with a white rim, or check the counts</source>
            <translation type="unfinished">aucune mire de {board_columns}x{board_rows} coins intérieurs n’est visible en entier ; montrez-la tout entière avec un bord blanc, ou vérifiez les nombres</translation>
        </message>
        <message>
            <source>the picture is mirrored; turn the camera's mirror mode off</source>
            <translation type="unfinished">l’image est en miroir ; désactivez le mode miroir de la caméra</translation>
        </message>
        <message>
            <source>only {first_size} corners are seen; {least_corners} are needed</source>
            <translation type="unfinished">seuls {first_size} coins sont visibles ; il en faut {least_corners}</translation>
        </message>
        <message>
            <source>{markers} markers of {board_dictionary} are seen, but they do not lie as on {board_spec}; {counted}</source>
            <translation type="unfinished">{markers} marqueurs de {board_dictionary} sont visibles, mais ne sont pas disposés comme sur {board_spec} ; {counted}</translation>
        </message>
        <message>
            <source>no ChArUco board with markers of {board_dictionary} is seen; check the dictionary</source>
            <translation type="unfinished">aucune mire ChArUco avec des marqueurs de {board_dictionary} n’est visible ; vérifiez le dictionnaire</translation>
        </message>
        <message>
            <source>check the counts of squares</source>
            <translation type="unfinished">vérifiez les nombres de carrés</translation>
        </message>
        <message>
            <source>they fit {larger_spec}: squares are counted, not inner corners</source>
            <translation type="unfinished">ils correspondent à {larger_spec} : on compte les carrés, non les coins intérieurs</translation>
        </message>
        <message>
            <source>the corners seen lie on one line; show more of the board</source>
            <translation type="unfinished">les coins visibles sont alignés ; montrez davantage de la mire</translation>
        </message>
        <message>
            <source>the board is seen on edge ({tilt_deg:.0f}°); turn it to the camera, up to {largest_tilt_deg:.0f}° are possible</source>
            <translation type="unfinished">la mire est vue par la tranche ({tilt_deg:.0f}°) ; tournez-la vers la caméra, jusqu’à {largest_tilt_deg:.0f}° sont possibles</translation>
        </message>
        <message>
            <source>a square is only {square_px:.1f} px across; {smallest_square:g} px are needed: bring the board nearer</source>
            <translation type="unfinished">un carré ne fait que {square_px:.1f} px ; il faut {smallest_square:g} px : rapprochez la mire</translation>
        </message>
        <message>
            <source>the corners found do not lie on a grid; check the board's counts</source>
            <translation type="unfinished">les coins trouvés ne forment pas une grille ; vérifiez les nombres de la mire</translation>
        </message>
        <message>
            <source>the board has more than {board_columns}x{board_rows} inner corners; count them anew</source>
            <translation type="unfinished">la mire a plus de {board_columns}x{board_rows} coins intérieurs ; recomptez-les</translation>
        </message>
        <message>
            <source>the picture is blurred: edges are {sharpness:.1f} px wide, squares {square_px:.0f} px; hold the board still and focus</source>
            <translation type="unfinished">l’image est floue : les bords sont larges de {sharpness:.1f} px, les carrés de {square_px:.0f} px ; ne bougez pas la mire et faites la mise au point</translation>
        </message>
        <message>
            <source>{together_px:.2f} px against {left_alone_px:.2f} and {right_alone_px:.2f}</source>
            <translation type="unfinished">{together_px:.2f} px contre {left_alone_px:.2f} et {right_alone_px:.2f}</translation>
        </message>
        <message>
            <source>standard deviations are multiplied by {result_sd_factor:.1f}</source>
            <translation type="unfinished">les écarts types sont multipliés par {result_sd_factor:.1f}</translation>
        </message>
        <message>
            <source>the pairs do not belong together: {px} px of each camera by itself; pictures not taken at the same moment, a board or a camera that moved do that: hold the board still and take them again; {done}</source>
            <translation type="unfinished">les paires ne vont pas ensemble : {px} px de chaque caméra seule ; cela vient d’images qui ne sont pas prises au même moment, ou d’une mire ou d’une caméra qui a bougé : ne bougez pas la mire et reprenez-les ; {done}</translation>
        </message>
        <message>
            <source>the two cameras fit together less well than each by itself ({px} px): {done}</source>
            <translation type="unfinished">les deux caméras s’accordent moins bien que chacune seule ({px} px) : {done}</translation>
        </message>
        <message>
            <source>{path}: a file of names and values is needed, got {shown}</source>
            <translation type="unfinished">{path} : il faut un fichier de noms et de valeurs, trouvé : {shown}</translation>
        </message>
        <message>
            <source>a number of at least 0</source>
            <translation type="unfinished">un nombre d’au moins 0</translation>
        </message>
        <message>
            <source>rows: {rows}, cols: {columns} and data</source>
            <translation type="unfinished">rows: {rows}, cols: {columns} et data</translation>
        </message>
        <message>
            <source>{rows} x {columns}</source>
            <translation type="unfinished">{rows} x {columns}</translation>
        </message>
        <message>
            <source>{rows} rows of {columns}</source>
            <translation type="unfinished">lignes : {rows} de {columns}</translation>
        </message>
        <message>
            <source>{count} values</source>
            <translation type="unfinished">valeurs : {count}</translation>
        </message>
        <message>
            <source>{rows} numbers</source>
            <translation type="unfinished">nombres : {rows}</translation>
        </message>
        <message>
            <source>a finite number</source>
            <translation type="unfinished">un nombre fini</translation>
        </message>
        <message>
            <source>{path}: {key}: {wanted} is needed, got {shown}</source>
            <translation type="unfinished">{path} : {key} : il faut {wanted}, trouvé : {shown}</translation>
        </message>
        <message>
            <source>{path}: {key} is missing; the file has {there}</source>
            <translation type="unfinished">{path} : {key} manque ; le fichier a {there}</translation>
        </message>
        <message>
            <source>a whole number of pixels from 16 to {largest_size}</source>
            <translation type="unfinished">un nombre entier de pixels de 16 à {largest_size}</translation>
        </message>
        <message>
            <source>{where}: fx 0 cx, 0 fy cy, 0 0 1 with positive focal lengths is needed, got {matrix}</source>
            <translation type="unfinished">{where} : il faut fx 0 cx, 0 fy cy, 0 0 1 avec des focales positives, trouvé : {matrix}</translation>
        </message>
        <message>
            <source>{where}: a skew of {skew} px is not supported; only 0 is</source>
            <translation type="unfinished">{where} : une obliquité de {skew} px n’est pas prise en charge ; seule 0 l’est</translation>
        </message>
        <message>
            <source>{where}: the first three columns are no rotation matrix: they differ from one by {error:.3g} (at most {rounded:g}) or mirror; got {matrix}</source>
            <translation type="unfinished">{where} : les trois premières colonnes ne sont pas une matrice de rotation : elles s’en écartent de {error:.3g} ({rounded:g} au plus) ou font miroir ; trouvé : {matrix}</translation>
        </message>
        <message>
            <source>{where}: its translation is {matrix} in units of {unit:g} m; cameras up to {farthest:g} m apart are read</source>
            <translation type="unfinished">{where} : sa translation est {matrix} en unités de {unit:g} m ; on lit des caméras distantes de {farthest:g} m au plus</translation>
        </message>
        <message>
            <source>{left_source} and {right_source}: both cameras stand at the same place; the pair needs two different poses. Was the same file given twice, or only one camera's pose?</source>
            <translation type="unfinished">{left_source} et {right_source} : les deux caméras sont au même endroit ; la paire demande deux poses différentes. Le même fichier a-t-il été donné deux fois, ou la pose d’une seule caméra ?</translation>
        </message>
        <message>
            <source>{left_source} and {right_source}: {error}</source>
            <translation type="unfinished">{left_source} et {right_source} : {error}</translation>
        </message>
        <message>
            <source>{where}: {valid} coefficients{named} are possible, got {coefficients}</source>
            <translation type="unfinished">{where} : {valid} coefficients{named} sont possibles, trouvé : {coefficients}</translation>
        </message>
        <message>
            <source>{where}: a tilted sensor (τx, τy = {tilt_x:g}, {tilt_y:g}) is not supported: calibrate without CALIB_TILTED_MODEL, or the pictures with `acus calibrate stereo`</source>
            <translation type="unfinished">{where} : un capteur incliné (τx, τy = {tilt_x:g}, {tilt_y:g}) n’est pas pris en charge : étalonnez sans CALIB_TILTED_MODEL, ou bien les images avec `acus calibrate stereo`</translation>
        </message>
        <message>
            <source>calibration {calibration_id} cannot be written to {path}: {error_strerror}; choose another place</source>
            <translation type="unfinished">impossible d’écrire l’étalonnage {calibration_id} dans {path} : {error_strerror} ; choisissez un autre emplacement</translation>
        </message>
        <message>
            <source>the lens of {camera_name} cannot be written to {path}: {error_strerror}; choose another place</source>
            <translation type="unfinished">impossible d’écrire l’objectif de {camera_name} dans {path} : {error_strerror} ; choisissez un autre emplacement</translation>
        </message>
        <message>
            <source>{path} is the lens of one camera; a calibration holds two and how they stand to each other. A pen takes it (`acus pen calibrate --lens`); for two cameras calibrate pairs of pictures (`acus calibrate stereo`)</source>
            <translation type="unfinished">{path} est l’objectif d’une seule caméra ; un étalonnage en contient deux et leur position relative. Un stylo l’accepte (`acus pen calibrate --lens`) ; pour deux caméras, étalonnez des paires d’images (`acus calibrate stereo`)</translation>
        </message>
        <message>
            <source>{path}: pose or camera cannot be: {error}</source>
            <translation type="unfinished">{path} : la pose ou la caméra est impossible : {error}</translation>
        </message>
        <message>
            <source>{folder}: two files cameraN_intrinsics.dat are needed, found {names}</source>
            <translation type="unfinished">{folder} : il faut deux fichiers cameraN_intrinsics.dat, trouvé : {names}</translation>
        </message>
        <message>
            <source>unit {unit} m: from 1e-6 (a micrometre) to 10 is valid</source>
            <translation type="unfinished">unité {unit} m : de 1e-6 (un micromètre) à 10 est valide</translation>
        </message>
        <message>
            <source>cannot read {path}: {error_strerror}; check its name and that it may be read</source>
            <translation type="unfinished">impossible de lire {path} : {error_strerror} ; vérifiez son nom et le droit de lecture</translation>
        </message>
        <message>
            <source>{path} is no text file; one of lines of numbers is needed, as TemugeB's program writes it</source>
            <translation type="unfinished">{path} n’est pas un fichier texte ; il en faut un fait de lignes de nombres, comme l’écrit le programme de TemugeB</translation>
        </message>
        <message>
            <source>{path}: no line {title!r}; the file begins {lines}</source>
            <translation type="unfinished">{path} : pas de ligne {title!r} ; le fichier commence par {lines}</translation>
        </message>
        <message>
            <source>{path}: {title} {needed_lines} lines of {columns} numbers are needed, got {numbers_by_line} numbers in {found_lines} lines</source>
            <translation type="unfinished">{path} : {title} il faut {needed_lines} lignes de {columns} nombres, trouvé : {numbers_by_line} nombres en {found_lines} lignes</translation>
        </message>
        <message>
            <source>{path}: {title} numbers are needed, got {line!r}</source>
            <translation type="unfinished">{path} : {title} il faut des nombres, trouvé : {line!r}</translation>
        </message>
        <message>
            <source>{path}: {title} finite numbers are needed, got {line!r}</source>
            <translation type="unfinished">{path} : {title} il faut des nombres finis, trouvé : {line!r}</translation>
        </message>
        <message>
            <source>{path}: its pose is missing: there is no {name} beside it</source>
            <translation type="unfinished">{path} : sa pose manque : il n’y a pas de {name} à côté</translation>
        </message>
        <message>
            <source>{named}: OpenCV's files hold neither unit nor picture size; say them, e.g. --unit 1cm (the unit in which the board's square was typed) --size 640x480</source>
            <translation type="unfinished">{named} : les fichiers d’OpenCV ne contiennent ni unité ni taille d’image ; indiquez-les, p. ex. --unit 1cm (l’unité dans laquelle le côté du carré de la mire a été saisi) --size 640x480</translation>
        </message>
        <message>
            <source>{named}: a lens of OpenCV's one-camera sample; it does not say how two cameras stand to each other. Give what stereo_calib writes (intrinsics.yml and extrinsics.yml), or calibrate the pictures with `acus calibrate stereo`</source>
            <translation type="unfinished">{named} : un objectif de l’exemple à une caméra d’OpenCV ; il ne dit pas comment deux caméras sont placées l’une par rapport à l’autre. Donnez ce qu’écrit stereo_calib (intrinsics.yml et extrinsics.yml), ou étalonnez les images avec `acus calibrate stereo`</translation>
        </message>
        <message>
            <source>{named}: a pair of OpenCV needs M1, D1, M2, D2 (intrinsics.yml) and R, T (extrinsics.yml), found {there}; give both files</source>
            <translation type="unfinished">{named} : une paire d’OpenCV demande M1, D1, M2, D2 (intrinsics.yml) et R, T (extrinsics.yml), trouvé : {there} ; donnez les deux fichiers</translation>
        </message>
        <message>
            <source>{path}: {key}: {rows} x {columns} numbers are needed, got {found_shape}</source>
            <translation type="unfinished">{path} : {key} : il faut {rows} x {columns} nombres, trouvé : {found_shape}</translation>
        </message>
        <message>
            <source>--unit {unit}: a length with its unit is needed, e.g. 1cm or 25.4mm</source>
            <translation type="unfinished">--unit {unit} : il faut une longueur avec son unité, p. ex. 1cm ou 25.4mm</translation>
        </message>
        <message>
            <source>--size {size}: WIDTHxHEIGHT in pixels is needed, e.g. 1280x720</source>
            <translation type="unfinished">--size {size} : il faut WIDTHxHEIGHT en pixels, p. ex. 1280x720</translation>
        </message>
        <message>
            <source>{files} files were given; {expected}</source>
            <translation type="unfinished">fichiers donnés : {files} ; {expected}</translation>
        </message>
        <message>
            <source>{left} and {right} are of different formats; {expected}</source>
            <translation type="unfinished">{left} et {right} sont de formats différents ; {expected}</translation>
        </message>
        <message>
            <source>{path} is no YAML file; {expected}</source>
            <translation type="unfinished">{path} n’est pas un fichier YAML ; {expected}</translation>
        </message>
        <message>
            <source>{folder}: TemugeB's files hold neither unit nor picture size; say them, e.g. --unit 1cm (the unit in which the board's square was typed) --size 1280x720</source>
            <translation type="unfinished">{folder} : les fichiers de TemugeB ne contiennent ni unité ni taille d’image ; indiquez-les, p. ex. --unit 1cm (l’unité dans laquelle le côté du carré de la mire a été saisi) --size 1280x720</translation>
        </message>
        <message>
            <source>camera_info cannot be written to {path}: {error_strerror}</source>
            <translation type="unfinished">impossible d’écrire camera_info dans {path} : {error_strerror}</translation>
        </message>
        <message>
            <source>the cameras look along the line between them: such a pair has no rectification and cannot be written as camera_info; export it as yaml</source>
            <translation type="unfinished">les caméras regardent le long de la ligne qui les relie : une telle paire n’a pas de rectification et ne peut pas être écrite en camera_info ; exportez-la en yaml</translation>
        </message>
        <message>
            <source>{path}: {error}; write it again</source>
            <translation type="unfinished">{path} : {error} ; récrivez-le</translation>
        </message>
        <message>
            <source>it is larger than {largest_file} MB; a calibration is not</source>
            <translation type="unfinished">il dépasse {largest_file} Mo ; un étalonnage n’est pas si grand</translation>
        </message>
        <message>
            <source>control characters are not read</source>
            <translation type="unfinished">les caractères de contrôle ne sont pas lus</translation>
        </message>
        <message>
            <source>it begins as a file of OpenCV's FileStorage but is damaged ({fault}); write it again</source>
            <translation type="unfinished">il commence comme un fichier FileStorage d’OpenCV, mais est endommagé ({fault}) ; récrivez-le</translation>
        </message>
        <message>
            <source>OpenCV cannot read it</source>
            <translation type="unfinished">OpenCV ne peut pas le lire</translation>
        </message>
        <message>
            <source>{double_name} is given twice</source>
            <translation type="unfinished">{double_name} est donné deux fois</translation>
        </message>
        <message>
            <source>{key}: a matrix with rows, cols, dt and data is needed</source>
            <translation type="unfinished">{key} : il faut une matrice avec rows, cols, dt et data</translation>
        </message>
        <message>
            <source>{key}: dt names the numbers' type, e.g. d; got {shown}</source>
            <translation type="unfinished">{key} : dt nomme le type des nombres, p. ex. d ; trouvé : {shown}</translation>
        </message>
        <message>
            <source>{key}: {rows} x {columns} numbers; at most {most} are read</source>
            <translation type="unfinished">{key} : {rows} x {columns} nombres ; {most} au plus sont lus</translation>
        </message>
        <message>
            <source>{key}: {rows} x {columns} numbers are needed, got {count} values</source>
            <translation type="unfinished">{key} : il faut {rows} x {columns} nombres, valeurs trouvées : {count}</translation>
        </message>
        <message>
            <source>{where}: a whole number from 1 to {most} is needed</source>
            <translation type="unfinished">{where} : il faut un nombre entier de 1 à {most}</translation>
        </message>
        <message>
            <source>{key}: a matrix of finite numbers is needed, got {shown}</source>
            <translation type="unfinished">{key} : il faut une matrice de nombres finis, trouvé : {shown}</translation>
        </message>
        <message>
            <source>{key}: a whole number is too large, got {length:.0f} or more</source>
            <translation type="unfinished">{key} : un nombre entier est trop grand, trouvé : {length:.0f} ou plus</translation>
        </message>
        <message>
            <source>{path}: id: {needed_id} is needed as the file's name says, got {stated_id}; was the file renamed?</source>
            <translation type="unfinished">{path} : id : il faut {needed_id} comme le dit le nom du fichier, trouvé : {stated_id} ; le fichier a-t-il été renommé ?</translation>
        </message>
        <message>
            <source>{trouble} with {beginning!r}; there are {names}</source>
            <translation type="unfinished">{trouble} par {beginning!r} ; il existe : {names}</translation>
        </message>
        <message>
            <source>a calibration cannot be called {name!r}: give it another id</source>
            <translation type="unfinished">un étalonnage ne peut pas s’appeler {name!r} : donnez-lui un autre identifiant</translation>
        </message>
        <message>
            <source>another calibration is already kept as {calibration_id}; nothing is overwritten: give this one another id</source>
            <translation type="unfinished">un autre étalonnage est déjà conservé sous {calibration_id} ; rien n’est écrasé : donnez à celui-ci un autre identifiant</translation>
        </message>
        <message>
            <source>calibration {entry_id} was found bad ({entry_rejected_reason}); calibrate again or use another one</source>
            <translation type="unfinished">l’étalonnage {entry_id} s’est révélé mauvais ({entry_rejected_reason}) ; refaites l’étalonnage ou utilisez-en un autre</translation>
        </message>
        <message>
            <source>no calibration is in use: there is nothing to undo</source>
            <translation type="unfinished">aucun étalonnage n’est en service : il n’y a rien à annuler</translation>
        </message>
        <message>
            <source>there is no undone calibration that could be used again</source>
            <translation type="unfinished">il n’y a pas d’étalonnage annulé qui puisse être repris</translation>
        </message>
        <message>
            <source>say why the calibration is bad: attempts are flagged with it</source>
            <translation type="unfinished">dites pourquoi l’étalonnage est mauvais : les essais sont signalés avec ce motif</translation>
        </message>
        <message>
            <source>the history of calibrations cannot be written to {path}: {error_strerror}</source>
            <translation type="unfinished">impossible d’écrire l’historique des étalonnages dans {path} : {error_strerror}</translation>
        </message>
        <message>
            <source>position {position} lies beyond the {used_positions} used</source>
            <translation type="unfinished">position {position} dépasse les {used_positions} utilisées</translation>
        </message>
        <message>
            <source>used names {unknown}, which no calibration has</source>
            <translation type="unfinished">used nomme {unknown}, qu’aucun étalonnage ne porte</translation>
        </message>
        <message>
            <source>{error}; mend the file or move it away</source>
            <translation type="unfinished">{error} ; corrigez le fichier ou mettez-le de côté</translation>
        </message>
        <message>
            <source>calibrate the cameras first: no calibration is in use</source>
            <translation type="unfinished">étalonnez d’abord les caméras : aucun étalonnage n’est en service</translation>
        </message>
        <message>
            <source>{name}: first estimate</source>
            <translation type="unfinished">{name} : première estimation</translation>
        </message>
        <message>
            <source>{name}: views held back</source>
            <translation type="unfinished">{name} : vues réservées</translation>
        </message>
        <message>
            <source>{name}: which coefficients the views support</source>
            <translation type="unfinished">{name} : coefficients que les vues permettent</translation>
        </message>
        <message>
            <source>first estimate</source>
            <translation type="unfinished">première estimation</translation>
        </message>
        <message>
            <source>camera {name}: {usable_views} usable views of the board; at least {least_views} are needed, 15 to 30 are good</source>
            <translation type="unfinished">caméra {name} : vues utilisables de la mire : {usable_views} ; il en faut au moins {least_views}, de 15 à 30 sont bien</translation>
        </message>
        <message>
            <source>camera {name}: views of different boards, {boards}</source>
            <translation type="unfinished">caméra {name} : vues de mires différentes, {boards}</translation>
        </message>
        <message>
            <source>camera {name}: pictures of different sizes: {view_name} has {width}x{height} ({differing_views} of {views} are not {usual_width}x{usual_height}); one camera at one resolution is needed: leave the others out</source>
            <translation type="unfinished">caméra {name} : images de tailles différentes : {view_name} a {width}x{height} ({differing_views} sur {views} n’ont pas {usual_width}x{usual_height}) ; il faut une caméra à une seule résolution : omettez les autres</translation>
        </message>
        <message>
            <source>camera {name}: the views do not determine the focal length ({focal_px:.0f} ± {spread_px:.0f} px; at most {most_focal_spread:.0%} is taken); boards that are all parallel cannot: tilt the board to different sides by 20 to 45 degrees</source>
            <translation type="unfinished">caméra {name} : les vues ne déterminent pas la focale ({focal_px:.0f} ± {spread_px:.0f} px ; {most_focal_spread:.0%} au plus est accepté) ; des mires toutes parallèles ne le peuvent pas : inclinez la mire de 20 à 45 degrés vers différents côtés</translation>
        </message>
        <message>
            <source>skipped: {names}: not pictures whose names say one of the two cameras</source>
            <translation type="unfinished">ignoré : {names} : pas des images dont le nom indique l’une des deux caméras</translation>
        </message>
        <message>
            <source>no partner: {names}: used for the {side} camera alone</source>
            <translation type="unfinished">sans partenaire : {names} : utilisé pour la caméra {side} seule</translation>
        </message>
        <message>
            <source>{listed}: the name does not say the camera; name pictures e.g. left01.png and right01.png, or camera0_1.png and camera1_1.png</source>
            <translation type="unfinished">{listed} : le nom ne dit pas quelle caméra ; nommez les images p. ex. left01.png et right01.png, ou camera0_1.png et camera1_1.png</translation>
        </message>
        <message>
            <source>the names of the pictures speak of {cameras} camera(s); two are needed, e.g. left01.png and right01.png</source>
            <translation type="unfinished">caméras désignées par les noms des images : {cameras} ; il en faut deux, p. ex. left01.png et right01.png</translation>
        </message>
        <message>
            <source>{listed}: no picture of the other camera has that number; name those taken together alike (docs/calibration.md says how names are paired)</source>
            <translation type="unfinished">{listed} : aucune image de l’autre caméra n’a ce numéro ; nommez de la même façon celles prises ensemble (docs/calibration.md dit comment les noms sont appariés)</translation>
        </message>
        <message>
            <source>{known_name} and {path_name} are both number {picture_number} of one camera; keep one of them</source>
            <translation type="unfinished">{known_name} et {path_name} portent tous deux le numéro {picture_number} d’une même caméra ; gardez-en un</translation>
        </message>
        <message>
            <source>{no_folder}; give the folder of the pictures</source>
            <translation type="unfinished">{no_folder} ; indiquez le dossier des images</translation>
        </message>
        <message>
            <source>no picture{named} in {folder}; choose the folder of the pictures ({suffixes} are read)</source>
            <translation type="unfinished">aucune image{named} dans {folder} ; choisissez le dossier des images ({suffixes} sont lus)</translation>
        </message>
        <message>
            <source>{count} pictures in {folder}, {most_pictures} are the most: put 20 to 200 of them, of different views, into a folder of their own</source>
            <translation type="unfinished">images dans {folder} : {count}, au plus {most_pictures} : mettez-en de 20 à 200, de vues différentes, dans un dossier à part</translation>
        </message>
        <message>
            <source>cannot be read: {error_strerror}</source>
            <translation type="unfinished">ne peut pas être lu : {error_strerror}</translation>
        </message>
        <message>
            <source>cannot be used: {short}</source>
            <translation type="unfinished">ne peut pas être utilisé : {short}</translation>
        </message>
        <message>
            <source>looking for the board</source>
            <translation type="unfinished">recherche de la mire</translation>
        </message>
        <message>
            <source>read at {name}</source>
            <translation type="unfinished">lu : {name}</translation>
        </message>
        <message>
            <source>the board measures {fit_scale:.4f} ± {fit_scale_sd:.4f} times what its specification says: measure a square, or was the calibration made with another board?</source>
            <translation type="unfinished">la mire mesure {fit_scale:.4f} ± {fit_scale_sd:.4f} fois ce que dit sa spécification : mesurez un carré, ou bien l’étalonnage a-t-il été fait avec une autre mire ?</translation>
        </message>
        <message>
            <source>the corners lie {fit_rms_px:.2f} px from where they should ({limit:.2f} px is the limit), worst in {worst_picture} ({worst_px:.2f} px): did the board move between the pictures, did a camera, or are left and right exchanged?</source>
            <translation type="unfinished">les coins sont à {fit_rms_px:.2f} px de leur place attendue (limite {limit:.2f} px), au pire dans {worst_picture} ({worst_px:.2f} px) : la mire ou une caméra a-t-elle bougé entre les images, ou gauche et droite sont-elles inversées ?</translation>
        </message>
        <message>
            <source>the place says that the print faces down; a board that lies print up is turned by 180 degrees about x: --at x,y,z,180,0,rz</source>
            <translation type="unfinished">la position indique que l’impression est tournée vers le bas ; une mire posée impression vers le haut est tournée de 180 degrés autour de x : --at x,y,z,180,0,rz</translation>
        </message>
        <message>
            <source>camera {camera_name} would look at the board from behind: is its picture mirrored, or is the calibration one of other cameras?</source>
            <translation type="unfinished">la caméra {camera_name} regarderait la mire par derrière : son image est-elle en miroir, ou l’étalonnage est-il celui d’autres caméras ?</translation>
        </message>
        <message>
            <source>camera {camera_name} stands {centre_mm:.0f} mm below the robot's plane (z = 0): is the board's place right?</source>
            <translation type="unfinished">la caméra {camera_name} est à {centre_mm:.0f} mm sous le plan du robot (z = 0) : la position de la mire est-elle juste ?</translation>
        </message>
        <message>
            <source>camera {model_name} does not see the needle's place: is the board's place right, and does the camera look at the needle?</source>
            <translation type="unfinished">la caméra {model_name} ne voit pas l’endroit de l’aiguille : la position de la mire est-elle juste, et la caméra regarde-t-elle l’aiguille ?</translation>
        </message>
        <message>
            <source>the places disagree by {away_mm:.1f} mm at the left camera: was a board laid wrongly?</source>
            <translation type="unfinished">les positions diffèrent de {away_mm:.1f} mm à la caméra gauche : une mire était-elle mal posée ?</translation>
        </message>
        <message>
            <source>the board was not seen within {live_timeout:.0f} s: {reason}</source>
            <translation type="unfinished">la mire n’a pas été vue en {live_timeout:.0f} s : {reason}</translation>
        </message>
        <message>
            <source>{folders} folders and {places} places were given; each folder needs the place of its board: --images DIR --at x,y,z[,rx,ry,rz]</source>
            <translation type="unfinished">dossiers donnés : {folders}, positions : {places} ; chaque dossier demande la position de sa mire : --images DIR --at x,y,z[,rx,ry,rz]</translation>
        </message>
        <message>
            <source>{folder}: {none_seen}</source>
            <translation type="unfinished">{folder} : {none_seen}</translation>
        </message>
        <message>
            <source>no camera explains the {views} views; tilt the board to different sides by 20 to 45 degrees, and check the board's counts</source>
            <translation type="unfinished">aucune caméra n’explique les {views} vues ; inclinez la mire de 20 à 45 degrés vers différents côtés, et vérifiez les nombres de la mire</translation>
        </message>
        <message>
            <source>view {view_name!r}: no pose of the board fits before the camera</source>
            <translation type="unfinished">vue {view_name!r} : aucune pose de la mire devant la caméra ne convient</translation>
        </message>
        <message>
            <source>view {view_name!r}: no pose of the board can be found</source>
            <translation type="unfinished">vue {view_name!r} : aucune pose de la mire n’a pu être trouvée</translation>
        </message>
        <message>
            <source>{name}: {r_name} does not fit ({r_rms_px:.2f} px against {adjusted_rms_px:.2f} px): left out</source>
            <translation type="unfinished">{name} : {r_name} ne convient pas ({r_rms_px:.2f} px contre {adjusted_rms_px:.2f} px) : omis</translation>
        </message>
        <message>
            <source>{name}: fy/fx = {ratio:.4f}: the pixels or the squares are not square; measure the print in both directions</source>
            <translation type="unfinished">{name} : fy/fx = {ratio:.4f} : les pixels ou les carrés n’ont pas des côtés égaux ; mesurez l’impression dans les deux directions</translation>
        </message>
        <message>
            <source>{name}: this lens is wider than the five-coefficient model, or bends otherwise: seen up to {angle:.0f}° off its axis, {five_px:.3f} px remain with five coefficients, {adjusted_rms_px:.3f} px with the {lens_words}: calibrated with that</source>
            <translation type="unfinished">{name} : cet objectif est plus large que le modèle à cinq coefficients, ou déforme autrement : vu jusqu’à {angle:.0f}° de son axe, il reste {five_px:.3f} px avec cinq coefficients, {adjusted_rms_px:.3f} px avec {lens_words} : étalonné ainsi</translation>
        </message>
        <message>
            <source>{name}: corners fit better unrefined and are taken so (blur, noise): {named}</source>
            <translation type="unfinished">{name} : des coins conviennent mieux sans affinage et sont pris ainsi (flou, bruit) : {named}</translation>
        </message>
        <message>
            <source>{name}: corners reach {reach:.0%} of the way to the picture's corners; distortion beyond is not measured: show the board at the edges too</source>
            <translation type="unfinished">{name} : les coins de la mire vont à {reach:.0%} du chemin vers les coins de l’image ; la distorsion au-delà n’est pas mesurée : montrez la mire aussi sur les bords</translation>
        </message>
        <message>
            <source>{mended} of {pairs} pairs had their corners numbered from opposite ends; mended: {mended_names}</source>
            <translation type="unfinished">paires aux coins numérotés depuis des bouts opposés : {mended} sur {pairs} ; corrigé : {mended_names}</translation>
        </message>
        <message>
            <source>{r_name} does not fit the other pairs ({r_rms_px:.2f} px against {adjusted_rms_px:.2f} px): left out</source>
            <translation type="unfinished">{r_name} ne va pas avec les autres paires ({r_rms_px:.2f} px contre {adjusted_rms_px:.2f} px) : omis</translation>
        </message>
        <message>
            <source>camera {right_name} stands {distance_mm:.0f} mm to the left of camera {left_name}: the two may be swapped</source>
            <translation type="unfinished">la caméra {right_name} est à {distance_mm:.0f} mm à gauche de la caméra {left_name} : les deux sont peut-être inversées</translation>
        </message>
        <message>
            <source>pictures of different sizes, {left_name} {w0}x{h0}, {right_name} {w1}x{h1}: the trainer takes both cameras at one size; set both to it and take the pictures again</source>
            <translation type="unfinished">images de tailles différentes, {left_name} {w0}x{h0}, {right_name} {w1}x{h1} : le simulateur prend les deux caméras à une même taille ; réglez-les toutes deux dessus et reprenez les images</translation>
        </message>
        <message>
            <source>{name}: the board moved while its pictures were read row by row (rolling shutter): it looks bent differently in each, by {moved:.2g} px, and focal length and distances come out wrong; lay the board down or hold it against something still, and take the pictures again, or use a camera with a global shutter</source>
            <translation type="unfinished">{name} : la mire bougeait pendant que ses images étaient lues ligne par ligne (obturateur déroulant) : elle paraît déformée différemment dans chacune, de {moved:.2g} px, et la focale et les distances en sortent fausses ; posez la mire ou tenez-la contre quelque chose de fixe et reprenez les images, ou utilisez une caméra à obturateur global</translation>
        </message>
        <message>
            <source>{left_views} left and {right_views} right views; they are taken in pairs: give None where a camera did not see the board</source>
            <translation type="unfinished">vues à gauche : {left_views}, à droite : {right_views} ; elles se prennent par paires : donnez None là où une caméra n’a pas vu la mire</translation>
        </message>
        <message>
            <source>pairs held back</source>
            <translation type="unfinished">paires réservées</translation>
        </message>
        <message>
            <source>calibrated</source>
            <translation type="unfinished">étalonnage fait</translation>
        </message>
        <message>
            <source>{name} = {estimate:.3g} ± {sd:.2g}: the views do not tell; taken as 0</source>
            <translation type="unfinished">{name} = {estimate:.3g} ± {sd:.2g} : les vues ne le disent pas ; pris égal à 0</translation>
        </message>
        <message>
            <source>{both} of {pairs} pairs show the board to both cameras; at least {least_pairs} are needed, 15 to 30 are good; {common_reasons}</source>
            <translation type="unfinished">paires montrant la mire aux deux caméras : {both} sur {pairs} ; il en faut au moins {least_pairs}, de 15 à 30 sont bien ; {common_reasons}</translation>
        </message>
        <message>
            <source>the board is usable in none of {pictures} pictures (or pairs); {common_reasons}</source>
            <translation type="unfinished">la mire n’est utilisable dans aucune des images (ou paires), examinées : {pictures} ; {common_reasons}</translation>
        </message>
        <message>
            <source>{pairs} pairs show the board to both cameras; at least {least_pairs} are needed, 15 to 30 are good</source>
            <translation type="unfinished">paires montrant la mire aux deux caméras : {pairs} ; il en faut au moins {least_pairs}, de 15 à 30 sont bien</translation>
        </message>
        <message>
            <source>which corner is which</source>
            <translation type="unfinished">quel coin est lequel</translation>
        </message>
        <message>
            <source>left and right show the same pictures: both come from one camera; choose another source for one of them</source>
            <translation type="unfinished">gauche et droite montrent les mêmes images : toutes deux viennent d’une seule caméra ; choisissez une autre source pour l’une d’elles</translation>
        </message>
        <message>
            <source>the two cameras stand at one place ({apart:.2f} mm apart, the board {far:.0f} mm away); both pictures seem to come from one camera: choose another source for one of them, or move them apart</source>
            <translation type="unfinished">les deux caméras sont au même endroit (écart de {apart:.2f} mm, la mire à {far:.0f} mm) ; les deux images semblent venir d’une seule caméra : choisissez une autre source pour l’une d’elles, ou écartez les caméras</translation>
        </message>
        <message>
            <source>the pictures of one of the two cameras are mirrored: the pairs fit once one side is mirrored back; turn mirror mode off in that camera's settings and take them again</source>
            <translation type="unfinished">les images de l’une des deux caméras sont en miroir : les paires concordent dès qu’un côté est remis à l’endroit ; désactivez le mode miroir dans les réglages de cette caméra et reprenez-les</translation>
        </message>
        <message>
            <source>the pairs do not agree on where the cameras stand: {agreeing_pairs} of {pairs} fit together within {agreement_near:.0f} px; pictures that were not taken together, cameras moved in between, or names paired wrongly do that</source>
            <translation type="unfinished">les paires ne s’accordent pas sur la position des caméras : {agreeing_pairs} sur {pairs} concordent à {agreement_near:.0f} px près ; cela vient d’images non prises ensemble, de caméras déplacées entre-temps ou de noms mal appariés</translation>
        </message>
        <message>
            <source>none of {pairs} pairs shares {least_shared} corners; nothing can be validated</source>
            <translation type="unfinished">paires : {pairs}, et aucune n’a {least_shared} coins communs ; rien ne peut être validé</translation>
        </message>
        <message>
            <source>rays of the two cameras are parallel; nothing can be triangulated</source>
            <translation type="unfinished">les rayons des deux caméras sont parallèles ; rien ne peut être triangulé</translation>
        </message>
        <message>
            <source>camera {camera_name}: {missing} corners lie where its distortion folds back; the calibration does not reach there</source>
            <translation type="unfinished">caméra {camera_name} : {missing} coins sont là où sa distorsion se replie ; l’étalonnage ne va pas jusque-là</translation>
        </message>
        <message>
            <source>a length that is known contradicts it: {against_text}</source>
            <translation type="unfinished">une longueur connue le contredit : {against_text}</translation>
        </message>
        <message>
            <source>where the marker comes</source>
            <translation type="unfinished">dans la zone du marqueur</translation>
        </message>
        <message>
            <source>in a quarter of its picture</source>
            <translation type="unfinished">dans un quart de son image</translation>
        </message>
        <message>
            <source>{name}: {where} its rays are known to ± {sd:.2g} px only, {mm:.2g} mm at {usual_distance_mm:.0f} mm ({good:.2g} mm is good): the board was not seen there; show it there too, up to the edges</source>
            <translation type="unfinished">{name} : {where}, ses rayons ne sont connus qu’à ± {sd:.2g} px, {mm:.2g} mm à {usual_distance_mm:.0f} mm ({good:.2g} mm est bien) : la mire n’y a pas été vue ; montrez-la aussi là, jusqu’aux bords</translation>
        </message>
        <message>
            <source>glue the board on something flat, take sharper pictures, check its counts and sizes</source>
            <translation type="unfinished">collez la mire sur un support plan, prenez des images plus nettes, vérifiez ses nombres et ses tailles</translation>
        </message>
        <message>
            <source>residual of {rms:.2f} px, at most {worst_px:.2g} px: {flat}</source>
            <translation type="unfinished">résidu de {rms:.2f} px, {worst_px:.2g} px au plus : {flat}</translation>
        </message>
        <message>
            <source>pairs held back are wrong by {checked_rms_mm:.2f} mm RMS at {away:.0f} mm</source>
            <translation type="unfinished">les paires réservées ont une erreur de {checked_rms_mm:.2f} mm RMS à {away:.0f} mm</translation>
        </message>
        <message>
            <source>{held}, at most {worst_share:.2g} mm: {flat}</source>
            <translation type="unfinished">{held}, {worst_share:.2g} mm au plus : {flat}</translation>
        </message>
        <message>
            <source>the pairs do not belong together: hold the board still while both cameras look, fix the cameras, and take them again</source>
            <translation type="unfinished">les paires ne vont pas ensemble : ne bougez pas la mire pendant que les deux caméras la regardent, fixez les caméras, et reprenez-les</translation>
        </message>
        <message>
            <source>rolling shutter: the board moved while the pictures of {named} were read row by row, which makes focal length and distances wrong and hardly shows in the residual: hold the board against something still, and take them again</source>
            <translation type="unfinished">obturateur déroulant : la mire bougeait pendant que les images de {named} étaient lues ligne par ligne, ce qui fausse la focale et les distances et se voit à peine dans le résidu : tenez la mire contre quelque chose de fixe, et reprenez-les</translation>
        </message>
        <message>
            <source>it fits, but no pair was held back to check it: take at least eight pairs</source>
            <translation type="unfinished">cela concorde, mais aucune paire n’a été réservée pour le contrôle : prenez au moins huit paires</translation>
        </message>
        <message>
            <source>more and sharper views will do better</source>
            <translation type="unfinished">des vues plus nombreuses et plus nettes feront mieux</translation>
        </message>
        <message>
            <source>residual of {rms:.2f} px, {good_px:.2g} px is good: {better}</source>
            <translation type="unfinished">résidu de {rms:.2f} px, {good_px:.2g} px est bien : {better}</translation>
        </message>
        <message>
            <source>{held}, {good_share:.2g} mm is good: {better}</source>
            <translation type="unfinished">{held}, {good_share:.2g} mm est bien : {better}</translation>
        </message>
        <message>
            <source>lengths on pairs held back are {checked_scale:.4f} times the true ones: {better}</source>
            <translation type="unfinished">les longueurs sur les paires réservées valent {checked_scale:.4f} fois les vraies : {better}</translation>
        </message>
        <message>
            <source>pairs that took no part come out right: {held}</source>
            <translation type="unfinished">les paires qui n’ont pas servi sortent justes : {held}</translation>
        </message>
        <message>
            <source>view {name!r}: {ids_size} corner numbers and pixels of shape {pixels_shape}; one finite pixel is needed for every corner</source>
            <translation type="unfinished">vue {name!r} : numéros de coin : {ids_size}, pixels de forme {pixels_shape} ; il faut un pixel fini pour chaque coin</translation>
        </message>
        <message>
            <source>view {name!r}: corner {corner_number} is not on the board {board_spec}, which has {corners}</source>
            <translation type="unfinished">vue {name!r} : le coin {corner_number} n’est pas sur la mire {board_spec}, qui en a {corners}</translation>
        </message>
        <message>
            <source>view {name!r}: unrefined pixels of shape {rough_shape}; one finite pixel is needed for every corner</source>
            <translation type="unfinished">vue {name!r} : pixels non affinés de forme {rough_shape} ; il faut un pixel fini pour chaque coin</translation>
        </message>
        <message>
            <source>no board was given: one picture of it at a known place is needed</source>
            <translation type="unfinished">aucune mire n’a été donnée : il en faut une image à un endroit connu</translation>
        </message>
        <message>
            <source>the board looks the same after half a turn, so the world could be turned by 180°: use a ChArUco board, or one with an odd and an even count of corners, or say where the cameras stand roughly (--rig)</source>
            <translation type="unfinished">la mire est identique après un demi-tour, le monde pourrait donc être tourné de 180° : utilisez une mire ChArUco, ou une mire avec un nombre impair et un nombre pair de coins, ou dites à peu près où sont les caméras (--rig)</translation>
        </message>
        <message>
            <source>a picture has shape {image_shape} and type {image_dtype}; (height, width, 3) and uint8 are needed: set the camera to colour</source>
            <translation type="unfinished">une image est de forme {image_shape} et de type {image_dtype} ; il faut (height, width, 3) et uint8 : réglez la caméra sur la couleur</translation>
        </message>
        <message>
            <source>{name}: the driver did not accept {asked} (it is at {got:g})</source>
            <translation type="unfinished">{name} : le pilote n’a pas accepté {asked} (valeur actuelle : {got:g})</translation>
        </message>
        <message>
            <source>the camera gives pictures of {given_width}x{given_height} where {width}x{height} was asked for; set `size` in the camera settings to one that the camera has and calibrate at it</source>
            <translation type="unfinished">la caméra donne des images de {given_width}x{given_height} alors que {width}x{height} étaient demandés ; mettez `size` dans les réglages de la caméra à une taille qu’elle possède et étalonnez à cette taille</translation>
        </message>
        <message>
            <source>camera {name} ({source}) gives pictures of {width}x{height}, not {known_width}x{known_height} ({reason}); set `size` in the camera settings, or calibrate again at this size</source>
            <translation type="unfinished">la caméra {name} ({source}) donne des images de {width}x{height}, et non de {known_width}x{known_height} ({reason}) ; réglez `size` dans les réglages de la caméra, ou refaites l’étalonnage à cette taille</translation>
        </message>
        <message>
            <source>camera {name} ({source}): {error}</source>
            <translation type="unfinished">caméra {name} ({source}) : {error}</translation>
        </message>
        <message>
            <source>a simulated camera needs a needle to look at; choose a real source here</source>
            <translation type="unfinished">une caméra simulée demande une aiguille à regarder ; choisissez ici une source réelle</translation>
        </message>
        <message>
            <source>no picture from the {side} camera</source>
            <translation type="unfinished">pas d’image de la caméra {side}</translation>
        </message>
        <message>
            <source>folder {folder} is not open; call open() first</source>
            <translation type="unfinished">le dossier {folder} n’est pas ouvert ; appelez d’abord open()</translation>
        </message>
        <message>
            <source>the {pictures} pictures of {folder} are over</source>
            <translation type="unfinished">les images de {folder} sont épuisées ({pictures})</translation>
        </message>
        <message>
            <source>the pictures of {folder} are of different sizes: {each}</source>
            <translation type="unfinished">les images de {folder} sont de tailles différentes : {each}</translation>
        </message>
        <message>
            <source>only the first {most} of {pictures} pictures were looked at</source>
            <translation type="unfinished">seules les {most} premières images sur {pictures} ont été examinées</translation>
        </message>
        <message>
            <source>{no_folder}; folder:PATH names a folder</source>
            <translation type="unfinished">{no_folder} ; folder:PATH désigne un dossier</translation>
        </message>
        <message>
            <source>no picture in {folder}; files that end in {endings} count</source>
            <translation type="unfinished">pas d’image dans {folder} ; comptent les fichiers qui finissent par {endings}</translation>
        </message>
        <message>
            <source>there is no video {path}; video:PATH names a file</source>
            <translation type="unfinished">il n’y a pas de vidéo {path} ; video:PATH désigne un fichier</translation>
        </message>
        <message>
            <source>{path} is no video that can be read</source>
            <translation type="unfinished">{path} n’est pas une vidéo lisible</translation>
        </message>
        <message>
            <source>video {path} is not open; call open() first</source>
            <translation type="unfinished">la vidéo {path} n’est pas ouverte ; appelez d’abord open()</translation>
        </message>
        <message>
            <source>a picture of {path} is damaged</source>
            <translation type="unfinished">une image de {path} est endommagée</translation>
        </message>
        <message>
            <source>the video {path} is over</source>
            <translation type="unfinished">la vidéo {path} est terminée</translation>
        </message>
        <message>
            <source>with times that go back</source>
            <translation type="unfinished">avec des temps qui reculent</translation>
        </message>
        <message>
            <source>with impossible times</source>
            <translation type="unfinished">avec des temps impossibles</translation>
        </message>
        <message>
            <source>{median:.1f} ± {error:.1f} ms (spread of a single picture {sd:.1f} ms, {n} changes)</source>
            <translation type="unfinished">{median:.1f} ± {error:.1f} ms (dispersion d’une seule image {sd:.1f} ms, changements : {n})</translation>
        </message>
        <message>
            <source>the pictures do not follow the blinking (correlation {agreement:.2f}, at least {least_agreement} is needed); put the camera close to the patch, out of other light, and hold its exposure</source>
            <translation type="unfinished">les images ne suivent pas le clignotement (corrélation {agreement:.2f}, il faut au moins {least_agreement}) ; placez la caméra près du carré, à l’abri d’autres lumières, et fixez son exposition</translation>
        </message>
        <message>
            <source>{changes} changes and {pictures} pictures are too few; at least {fewest_changes} and {fewest_pictures} are needed: let the test run to its end</source>
            <translation type="unfinished">trop peu : changements {changes}, images {pictures} ; il en faut au moins {fewest_changes} et {fewest_pictures} : laissez le test aller jusqu’au bout</translation>
        </message>
        <message>
            <source>the times of the changes must increase; repeat the test</source>
            <translation type="unfinished">les temps des changements doivent croître ; recommencez le test</translation>
        </message>
        <message>
            <source>the patch changes the picture by {contrast:.1f} grey levels, at least {least_contrast:g} are needed; point the camera at the patch, and check its exposure</source>
            <translation type="unfinished">le carré change l’image de {contrast:.1f} niveaux de gris, il en faut au moins {least_contrast:g} ; dirigez la caméra vers le carré, et vérifiez son exposition</translation>
        </message>
        <message>
            <source>{seen} changes were seen, at least {fewest} are needed; the patch must stay longer between two changes than two pictures of the camera</source>
            <translation type="unfinished">changements vus : {seen}, il en faut au moins {fewest} ; le carré doit rester entre deux changements plus longtemps que l’écart entre deux images de la caméra</translation>
        </message>
        <message>
            <source>a picture of {width}x{height} is too small for the test of latency</source>
            <translation type="unfinished">une image de {width}x{height} est trop petite pour le test de latence</translation>
        </message>
        <message>
            <source>no picture came while the patch was blinking; is the camera running?</source>
            <translation type="unfinished">aucune image n’est arrivée pendant que le carré clignotait ; la caméra tourne-t-elle ?</translation>
        </message>
        <message>
            <source>no camera at usb:{place}; {plugged_in}</source>
            <translation type="unfinished">pas de caméra à usb:{place} ; {plugged_in}</translation>
        </message>
        <message>
            <source>none is plugged in: check the cable, and `acus camera list`</source>
            <translation type="unfinished">aucune n’est branchée : vérifiez le câble et `acus camera list`</translation>
        </message>
        <message>
            <source>plugged in are: </source>
            <translation type="unfinished">sont branchées : </translation>
        </message>
        <message>
            <source>one camera is real and one simulated (left {left}, right {right}); give both a source, for example --cameras left=usb:1-1.1,right=usb:1-1.2</source>
            <translation type="unfinished">une caméra est réelle et une simulée (gauche {left}, droite {right}) ; donnez une source aux deux, par exemple --cameras left=usb:1-1.1,right=usb:1-1.2</translation>
        </message>
        <message>
            <source>left and right are the same source, {left}; the depth needs two cameras: `acus camera list` shows what is plugged in</source>
            <translation type="unfinished">gauche et droite sont la même source, {left} ; la profondeur demande deux caméras : `acus camera list` montre ce qui est branché</translation>
        </message>
        <message>
            <source>{wanted!r} names no cameras; give `simulated`, a settings file (.yaml), or left=SOURCE,right=SOURCE, for example left=usb:1-1.1,right=usb:1-1.2</source>
            <translation type="unfinished">{wanted!r} ne désigne pas de caméras ; donnez `simulated`, un fichier de réglages (.yaml), ou left=SOURCE,right=SOURCE, par exemple left=usb:1-1.1,right=usb:1-1.2</translation>
        </message>
        <message>
            <source>{source!r} is no source of pictures; valid are: {forms}</source>
            <translation type="unfinished">{source!r} n’est pas une source d’images ; sont valides : {forms}</translation>
        </message>
        <message>
            <source>the source {source!r} {lack}; valid are: {forms}</source>
            <translation type="unfinished">la source {source!r} {lack} ; sont valides : {forms}</translation>
        </message>
        <message>
            <source>cannot write {folder}.png</source>
            <translation type="unfinished">impossible d’écrire {folder}.png</translation>
        </message>
        <message>
            <source>cannot write into {folder}: {error_strerror}</source>
            <translation type="unfinished">impossible d’écrire dans {folder} : {error_strerror}</translation>
        </message>
        <message>
            <source>there is no folder {origin_place}</source>
            <translation type="unfinished">il n’y a pas de dossier {origin_place}</translation>
        </message>
        <message>
            <source>there is no video {origin_place}</source>
            <translation type="unfinished">il n’y a pas de vidéo {origin_place}</translation>
        </message>
        <message>
            <source>{saturated:.0%} of the picture is overexposed: lower the exposure</source>
            <translation type="unfinished">{saturated:.0%} de l’image est surexposé : réduisez l’exposition</translation>
        </message>
        <message>
            <source>the picture is dark (mean {brightness:.0f} of 255): more light</source>
            <translation type="unfinished">l’image est sombre (moyenne {brightness:.0f} sur 255) : plus de lumière</translation>
        </message>
        <message>
            <source>the picture is noisy ({noise:.0f} grey values where it is even): more light, so that the camera amplifies less, or a longer exposure</source>
            <translation type="unfinished">l’image est bruitée ({noise:.0f} valeurs de gris là où elle est uniforme) : plus de lumière, pour que la caméra amplifie moins, ou une exposition plus longue</translation>
        </message>
        <message>
            <source>{figures_repeated_share:.0%} of the pictures repeat: lower the rate, or plug the cameras into ports of different USB controllers</source>
            <translation type="unfinished">{figures_repeated_share:.0%} des images se répètent : réduisez la cadence, ou branchez les caméras sur des ports de contrôleurs USB différents</translation>
        </message>
        <message>
            <source>{cameras} cameras have {names} names</source>
            <translation type="unfinished">caméras : {cameras}, noms : {names}</translation>
        </message>
        <message>
            <source>the camera is closed</source>
            <translation type="unfinished">la caméra est fermée</translation>
        </message>
        <message>
            <source>the camera was closed</source>
            <translation type="unfinished">la caméra a été fermée</translation>
        </message>
        <message>
            <source>no picture for {seconds:g} s; check the camera's cable</source>
            <translation type="unfinished">pas d’image depuis {seconds:g} s ; vérifiez le câble de la caméra</translation>
        </message>
        <message>
            <source>{node} cannot be opened; another program may use it, or the group `video` is missing</source>
            <translation type="unfinished">{node} ne peut pas être ouvert ; un autre programme l’utilise peut-être, ou le groupe `video` manque</translation>
        </message>
        <message>
            <source>{node} stopped delivering; was it unplugged?</source>
            <translation type="unfinished">{node} n’envoie plus rien ; la caméra a-t-elle été débranchée ?</translation>
        </message>
        <message>
            <source>{broken} pictures of {node} could not be decoded</source>
            <translation type="unfinished">images de {node} impossibles à décoder : {broken}</translation>
        </message>
        <message>
            <source>the driver of usb:{place} hangs in its last stream; unplug the camera</source>
            <translation type="unfinished">le pilote de usb:{place} est bloqué dans son dernier flux ; débranchez la caméra</translation>
        </message>
        <message>
            <source>camera usb:{place} is not open; call open() first</source>
            <translation type="unfinished">la caméra usb:{place} n’est pas ouverte ; appelez d’abord open()</translation>
        </message>
        <message>
            <source>the picture is {plain}; look at the lens cap, the light, the exposure</source>
            <translation type="unfinished">l’image est {plain} ; regardez le cache de l’objectif, la lumière, l’exposition</translation>
        </message>
        <message>
            <source>the picture does not change any more; plug the camera in again</source>
            <translation type="unfinished">l’image ne change plus ; rebranchez la caméra</translation>
        </message>
        <message>
            <source>no picture for {age:.1f} s{refused}: this computer is too busy to draw them; close other programs</source>
            <translation type="unfinished">pas d’image depuis {age:.1f} s{refused} : cet ordinateur est trop occupé pour les dessiner ; fermez les autres programmes</translation>
        </message>
        <message>
            <source>no picture for {age:.1f} s{refused}; check its cable</source>
            <translation type="unfinished">pas d’image depuis {age:.1f} s{refused} ; vérifiez son câble</translation>
        </message>
        <message>
            <source>its capture times cannot be used: {intake_figures_text}</source>
            <translation type="unfinished">ses temps de prise de vue sont inutilisables : {intake_figures_text}</translation>
        </message>
        <message>
            <source>the needle bends: up to {size_mm:.1f} mm off its line at the band</source>
            <translation type="unfinished">l’aiguille fléchit : jusqu’à {size_mm:.1f} mm de son axe à la bande</translation>
        </message>
        <message>
            <source>the cameras see the needle turned by {turn_deg:.1f}° from the robot's direction: home the robot again, then run the daily check</source>
            <translation type="unfinished">les caméras voient l’aiguille tournée de {turn_deg:.1f}° par rapport à la direction du robot : refaites la prise d’origine du robot, puis la vérification du jour</translation>
        </message>
        <message>
            <source>the cameras see the needle {rms_mm:.1f} mm beside the robot's line: move it through its whole depth to tell a bent needle from a camera that was moved</source>
            <translation type="unfinished">les caméras voient l’aiguille à {rms_mm:.1f} mm de l’axe du robot : déplacez-la sur toute sa profondeur pour distinguer une aiguille pliée d’une caméra déplacée</translation>
        </message>
        <message>
            <source>towards the tip</source>
            <translation type="unfinished">vers la pointe</translation>
        </message>
        <message>
            <source>towards the hub</source>
            <translation type="unfinished">vers l’embase</translation>
        </message>
        <message>
            <source>the tip touches known places {slip_mm:.1f} mm from where the cameras see it: the marker has slipped {where}; set it back to its mark</source>
            <translation type="unfinished">la pointe touche des endroits connus à {slip_mm:.1f} mm de là où les caméras la voient : le marqueur a glissé {where} ; remettez-le sur son repère</translation>
        </message>
        <message>
            <source>the marker's colour {bgr} (blue, green, red) is grey; a marker needs a colour that nothing else has: click on its middle, not on the shaft</source>
            <translation type="unfinished">la couleur du marqueur {bgr} (bleu, vert, rouge) est grise ; un marqueur demande une couleur que rien d’autre n’a : cliquez en son milieu, pas sur la tige de l’aiguille</translation>
        </message>
        <message>
            <source>the click at ({u}, {v}) is outside the picture of {width}x{height}</source>
            <translation type="unfinished">le clic à ({u}, {v}) est hors de l’image de {width}x{height}</translation>
        </message>
        <message>
            <source>the marker is overexposed where you clicked; lower exposure or light</source>
            <translation type="unfinished">le marqueur est surexposé là où vous avez cliqué ; réduisez l’exposition ou la lumière</translation>
        </message>
        <message>
            <source>the colour at ({u}, {v}) is nearly grey (strength {strongest:.0f}, at least {least_strength:.0f} is needed): click on the middle of the marker</source>
            <translation type="unfinished">la couleur à ({u}, {v}) est presque grise (intensité {strongest:.0f}, il faut au moins {least_strength:.0f}) : cliquez au milieu du marqueur</translation>
        </message>
        <message>
            <source>the marker is out of view of the {other} camera</source>
            <translation type="unfinished">le marqueur est hors de vue de la caméra {other}</translation>
        </message>
        <message>
            <source>{lost}; the {name} camera's pixel has no ray</source>
            <translation type="unfinished">{lost} ; le pixel de la caméra {name} n’a pas de rayon</translation>
        </message>
        <message>
            <source>{lost}, and the {name} camera looks along the needle, within {least_angle_deg:.0f}°: it cannot tell the depth</source>
            <translation type="unfinished">{lost}, et la caméra {name} regarde le long de l’aiguille, à {least_angle_deg:.0f}° près : elle ne peut pas donner la profondeur</translation>
        </message>
        <message>
            <source>{lost}; the {name} camera sees it off the needle's line</source>
            <translation type="unfinished">{lost} ; la caméra {name} le voit hors de l’axe de l’aiguille</translation>
        </message>
        <message>
            <source>{lost}; the {name} camera sees it {pixels:.1f} px beside the needle's line</source>
            <translation type="unfinished">{lost} ; la caméra {name} le voit à {pixels:.1f} px de l’axe de l’aiguille</translation>
        </message>
        <message>
            <source>{lost}: depth by the {name} camera and the needle's line</source>
            <translation type="unfinished">{lost} : profondeur d’après la caméra {name} et l’axe de l’aiguille</translation>
        </message>
        <message>
            <source>covariance needs {size} rows of {size} numbers, in the order {names}</source>
            <translation type="unfinished">covariance demande {size} lignes de {size} nombres, dans l’ordre {names}</translation>
        </message>
        <message>
            <source>ray_sd_px needs {rows} rows of {columns} numbers</source>
            <translation type="unfinished">ray_sd_px demande {rows} lignes de {columns} nombres</translation>
        </message>
        <message>
            <source>estimated names {unknown}; there are {names}</source>
            <translation type="unfinished">estimated nomme {unknown} ; il existe {names}</translation>
        </message>
        <message>
            <source>distortion: {given_numbers} numbers; lens {lens} has {needed_numbers}: </source>
            <translation type="unfinished">distortion : {given_numbers} nombres ; l’objectif {lens} en a {needed_numbers} : </translation>
        </message>
        <message>
            <source>joint_covariance needs {size} rows of {size} numbers: left, right, pose</source>
            <translation type="unfinished">joint_covariance demande {size} lignes de {size} nombres : gauche, droite, pose</translation>
        </message>
        <message>
            <source>world_by_cameras needs 6 rows of {size} numbers: left, right, pose</source>
            <translation type="unfinished">world_by_cameras demande 6 lignes de {size} nombres : gauche, droite, pose</translation>
        </message>
        <message>
            <source>camera {name}: distortion {distortion}: no lens has a coefficient beyond {wildest:g}; calibrate the camera again</source>
            <translation type="unfinished">caméra {name} : distortion {distortion} : aucun objectif n’a de coefficient au-delà de {wildest:g} ; refaites l’étalonnage de la caméra</translation>
        </message>
        <message>
            <source>camera {name}: focal lengths {intrinsics} px and image size {image_size} must be positive, the size at least 16 px</source>
            <translation type="unfinished">caméra {name} : les focales {intrinsics} px et la taille d’image {image_size} doivent être positives, la taille d’au moins 16 px</translation>
        </message>
        <message>
            <source>{count} coefficients: {distortion_brown}, {distortion_rational} (rational with thin prism) or {distortion_fisheye} (fisheye) are possible</source>
            <translation type="unfinished">coefficients : {count} ; sont possibles {distortion_brown}, {distortion_rational} (rationnel avec prisme mince) ou {distortion_fisheye} (fisheye)</translation>
        </message>
        <message>
            <source>camera {name}: looks_at_mm {looks_at_mm} lies straight above, below or at position_mm {position_mm}; move it sideways: the roll needs that</source>
            <translation type="unfinished">caméra {name} : looks_at_mm {looks_at_mm} est juste au-dessus, au-dessous ou à l’endroit de position_mm {position_mm} ; décalez-le de côté : le roulis le demande</translation>
        </message>
        <message>
            <source>hidden_mm {hidden_mm} must name the smaller depth first, or be left out where nothing hides the band</source>
            <translation type="unfinished">hidden_mm {hidden_mm} doit donner d’abord la plus petite profondeur, ou être omis si rien ne cache la bande</translation>
        </message>
        <message>
            <source>second_marker_offset_mm {second} must lie between {least} (half a band's length of bare shaft behind the first) and the needle's length of {length_mm}</source>
            <translation type="unfinished">second_marker_offset_mm {second} doit être compris entre {least} (une demi-longueur de bande de tige nue derrière le premier) et la longueur de l’aiguille, {length_mm}</translation>
        </message>
        <message>
            <source>calibration {calibration_id} has no world frame; lay the board at its known place and run `acus calibrate world`</source>
            <translation type="unfinished">l’étalonnage {calibration_id} n’a pas de repère monde ; posez la mire à son endroit connu et lancez `acus calibrate world`</translation>
        </message>
        <message>
            <source>calibration {calibration_id} is of the cameras {names}; rig {name} has {wanted}</source>
            <translation type="unfinished">l’étalonnage {calibration_id} est celui des caméras {names} ; le montage {name} a {wanted}</translation>
        </message>
        <message>
            <source>no camera rig is called {name_or_path!r}; there are {names}, or give the path of a .yaml file</source>
            <translation type="unfinished">aucun montage de caméras ne s’appelle {name_or_path!r} ; il existe {names}, ou donnez le chemin d’un fichier .yaml</translation>
        </message>
        <message>
            <source>{name} sees nothing of it: the camera looks another way</source>
            <translation type="unfinished">{name} n’en voit rien : la caméra regarde ailleurs</translation>
        </message>
        <message>
            <source>part of it at {ranges}</source>
            <translation type="unfinished">une partie à {ranges}</translation>
        </message>
        <message>
            <source>{name} loses {texts} mm depth</source>
            <translation type="unfinished">{name} perd {texts} mm de profondeur</translation>
        </message>
        <message>
            <source>the range ends at {reach_depth_max_mm:g} mm, above its beginning at {reach_depth_min_mm:g} mm; swap depth_min_mm and depth_max_mm</source>
            <translation type="unfinished">la plage finit à {reach_depth_max_mm:g} mm, au-dessus de son début à {reach_depth_min_mm:g} mm ; échangez depth_min_mm et depth_max_mm</translation>
        </message>
        <message>
            <source>the {name} has the marker ids {ids}; each must stand once</source>
            <translation type="unfinished">{name} a les numéros de marqueurs {ids} ; chacun doit figurer une seule fois</translation>
        </message>
        <message>
            <source>the {name} needs marker {marker_number}; {dictionary} has 0 to {largest_number}</source>
            <translation type="unfinished">{name} demande le marqueur {marker_number} ; {dictionary} a de 0 à {largest_number}</translation>
        </message>
        <message>
            <source>no ArUco dictionary is called {name!r}; usual is DICT_4X4_50</source>
            <translation type="unfinished">aucun dictionnaire ArUco ne s’appelle {name!r} ; DICT_4X4_50 est l’usuel</translation>
        </message>
        <message>
            <source>an id stands on cube and sheet; give the sheet another first_id</source>
            <translation type="unfinished">un numéro est à la fois sur le cube et sur la feuille ; donnez à la feuille un autre first_id</translation>
        </message>
        <message>
            <source>marker_mm {marker_mm:g} leaves {quiet:.1f} mm of white on an edge of {edge_mm:g} mm; {needed:.1f} mm are needed</source>
            <translation type="unfinished">marker_mm {marker_mm:g} laisse {quiet:.1f} mm de blanc sur une arête de {edge_mm:g} mm ; il faut {needed:.1f} mm</translation>
        </message>
        <message>
            <source>top needs 4 sides, not {sides}</source>
            <translation type="unfinished">top demande 4 côtés, et non {sides}</translation>
        </message>
        <message>
            <source>cube and sheet need one dictionary</source>
            <translation type="unfinished">le cube et la feuille demandent un même dictionnaire</translation>
        </message>
        <message>
            <source>no pen is called {name_or_path!r}; there are {shipped_pens}, or give the path of a .yaml file</source>
            <translation type="unfinished">aucun stylo ne s’appelle {name_or_path!r} ; il existe {shipped_pens}, ou donnez le chemin d’un fichier .yaml</translation>
        </message>
        <message>
            <source>the tip lies {length_mm:.0f} mm from the middle of the cube; 20 mm are the least from which its direction can be told</source>
            <translation type="unfinished">la pointe est à {length_mm:.0f} mm du milieu du cube ; il faut au moins 20 mm pour en connaître la direction</translation>
        </message>
        <message>
            <source>{poses} poses are too few to find the shaft; roll on until there are {fewest}</source>
            <translation type="unfinished">{poses} positions ne suffisent pas pour trouver la tige ; continuez à rouler jusqu’à en avoir {fewest}</translation>
        </message>
        <message>
            <source>the pen was rolled too little: roll it by a quarter turn or more about its own axis, lying in a groove</source>
            <translation type="unfinished">le stylo a été trop peu roulé : roulez-le d’un quart de tour ou plus autour de son axe, posé dans une rainure</translation>
        </message>
        <message>
            <source>the shaft did not keep its direction while it was rolled: lay it into a groove, for instance between two books, and roll it there</source>
            <translation type="unfinished">la tige n’a pas gardé sa direction pendant le roulement : posez-la dans une rainure, par exemple entre deux livres, et roulez-la là</translation>
        </message>
        <message>
            <source>on {poses} positions held back the tip was {rms_mm:.2f} mm from its dimple (at most {worst_mm:.1f} mm)</source>
            <translation type="unfinished">aux positions réservées ({poses}), la pointe était à {rms_mm:.2f} mm de son creux ({worst_mm:.1f} mm au plus)</translation>
        </message>
        <message>
            <source>tip at ({x:.1f}, {y:.1f}, {z:.1f}) mm from the middle of the cube, standard deviation {tip_sd_mm:.2f} mm; it stood still to {tip_rms_mm:.2f} mm in {tip_poses} poses ({tip_left_out} left out); axis to {axis_sd_deg:.2f}°</source>
            <translation type="unfinished">pointe à ({x:.1f}, {y:.1f}, {z:.1f}) mm du milieu du cube, écart type {tip_sd_mm:.2f} mm ; elle est restée immobile à {tip_rms_mm:.2f} mm près, positions : {tip_poses} (omises : {tip_left_out}) ; axe à {axis_sd_deg:.2f}°</translation>
        </message>
        <message>
            <source>the {name} is seen too flat: two poses {apart_deg:.0f}° apart look the same; turn it so that two faces show, or move the webcam to the side</source>
            <translation type="unfinished">{name} est vu trop à plat : deux poses à {apart_deg:.0f}° l’une de l’autre se ressemblent ; tournez pour montrer deux faces, ou déplacez la webcam sur le côté</translation>
        </message>
        <message>
            <source>tip within ± {tip_radius_mm:.1f} mm (95 %), axis within ± {axis_cone_deg:.1f}°</source>
            <translation type="unfinished">pointe à ± {tip_radius_mm:.1f} mm (95 %), axe à ± {axis_cone_deg:.1f}°</translation>
        </message>
        <message>
            <source>the {name} needs {wide:.0f} x {high:.0f} mm and does not fit on {paper_name}; take larger paper or smaller faces in the pen's profile</source>
            <translation type="unfinished">{name} demande {wide:.0f} x {high:.0f} mm et ne tient pas sur {paper_name} ; prenez un papier plus grand ou des faces plus petites dans le profil du stylo</translation>
        </message>
        <message>
            <source>{poses} poses are too few to find the tip; rock the pen until there are {fewest}</source>
            <translation type="unfinished">{poses} positions ne suffisent pas pour trouver la pointe ; basculez le stylo jusqu’à en avoir {fewest}</translation>
        </message>
        <message>
            <source>the pen was held still: rock it by 30° to every side with its tip in the dimple</source>
            <translation type="unfinished">le stylo n’a pas bougé : basculez-le de 30° de tous les côtés, la pointe dans le creux</translation>
        </message>
        <message>
            <source>the pen was {how}: the tip's place along that axis stays open; rock it by 30° to every side with its tip in the dimple</source>
            <translation type="unfinished">le stylo a été {how} : la place de la pointe le long de cet axe reste indéterminée ; basculez-le de 30° de tous les côtés, la pointe dans le creux</translation>
        </message>
        <message>
            <source>{contradicting} of {poses} poses contradict the others: the tip slipped; press it into the dimple and rock again</source>
            <translation type="unfinished">positions qui contredisent les autres : {contradicting} sur {poses} : la pointe a glissé ; appuyez-la dans le creux et basculez de nouveau</translation>
        </message>
        <message>
            <source>the tip is known to {result_sd_mm:.1f} mm only (standard deviation), the limit is {largest_sd_mm:.0f} mm: rock it further, nearer to the webcam</source>
            <translation type="unfinished">la pointe n’est connue qu’à {result_sd_mm:.1f} mm (écart type), la limite est de {largest_sd_mm:.0f} mm : continuez à basculer, plus près de la webcam</translation>
        </message>
        <message>
            <source>{path} has no camera {camera!r}; there are {names}</source>
            <translation type="unfinished">{path} n’a pas de caméra {camera!r} ; il existe {names}</translation>
        </message>
        <message>
            <source>the picture is mirrored: switch mirroring off in the webcam's own settings</source>
            <translation type="unfinished">l’image est en miroir : désactivez le mode miroir dans les réglages de la webcam</translation>
        </message>
        <message>
            <source>marker {marker_number} is in view twice: two pens, or a mirror; take one away</source>
            <translation type="unfinished">le marqueur {marker_number} est visible deux fois : deux stylos, ou un miroir ; enlevez-en un</translation>
        </message>
        <message>
            <source>; it is cut off, covered or too small</source>
            <translation type="unfinished">; partie coupée, couverte ou trop petite</translation>
        </message>
        <message>
            <source>the {name} is out of view{reason}</source>
            <translation type="unfinished">{name} est hors de vue{reason}</translation>
        </message>
        <message>
            <source>the sheet is out of view, so the webcam's place is not known; show both</source>
            <translation type="unfinished">la feuille est hors de vue, la place de la webcam n’est donc pas connue ; montrez les deux</translation>
        </message>
        <message>
            <source>the pictures are {picture_width}x{picture_height}, the calibration is of {calibrated_width}x{calibrated_height}; set the webcam to that size or calibrate it anew (`acus calibrate mono`)</source>
            <translation type="unfinished">les images font {picture_width}x{picture_height}, l’étalonnage est pour {calibrated_width}x{calibrated_height} ; réglez la webcam sur cette taille ou refaites son étalonnage (`acus calibrate mono`)</translation>
        </message>
        <message>
            <source>THE LENS IS GUESSED from the size of the picture: calibrate it with `acus calibrate mono`, the needle is several times less certain until then</source>
            <translation type="unfinished">L’OBJECTIF EST ESTIMÉ d’après la taille de l’image : étalonnez-le avec `acus calibrate mono`, d’ici là l’aiguille est plusieurs fois moins sûre</translation>
        </message>
        <message>
            <source>lens calibrated ({calibration_views} views, {calibration_rms_px:.2f} px)</source>
            <translation type="unfinished">objectif étalonné (vues : {calibration_views}, {calibration_rms_px:.2f} px)</translation>
        </message>
        <message>
            <source>is no picture: {error_err}</source>
            <translation type="unfinished">n’est pas une image : {error_err}</translation>
        </message>
        <message>
            <source>is no picture or is damaged</source>
            <translation type="unfinished">n’est pas une image, ou est endommagé</translation>
        </message>
        <message>
            <source>has more than {side} x {side} pixels, which are the most: make it smaller, or take it out of the folder</source>
            <translation type="unfinished">a plus de {side} x {side} pixels, le maximum : réduisez l’image, ou retirez-la du dossier</translation>
        </message>
        <message>
            <source>there is no folder {path}</source>
            <translation type="unfinished">il n’y a pas de dossier {path}</translation>
        </message>
        <message>
            <source>camera {renderer_model_name} is not open; call open() first</source>
            <translation type="unfinished">la caméra {renderer_model_name} n’est pas ouverte ; appelez d’abord open()</translation>
        </message>
        <message>
            <source>a tone curve needs linear light (uint16), got a picture of {light_dtype}; build the renderer with light=True</source>
            <translation type="unfinished">une courbe de tons demande de la lumière linéaire (uint16), reçu une image de {light_dtype} ; construisez le moteur de rendu avec light=True</translation>
        </message>
        <message>
            <source>OpenCV cannot code a picture of {image_shape} as JPEG</source>
            <translation type="unfinished">OpenCV ne peut pas coder en JPEG une image de forme {image_shape}</translation>
        </message>
        <message>
            <source>no effect on pictures is called {effect_name!r}; there are {by_name}</source>
            <translation type="unfinished">aucun effet sur les images ne s’appelle {effect_name!r} ; il existe {by_name}</translation>
        </message>
        <message>
            <source>a pixel has no ray</source>
            <translation type="unfinished">un pixel n’a pas de rayon</translation>
        </message>
        <message>
            <source>the rays are {status}</source>
            <translation type="unfinished">état des rayons : {status}</translation>
        </message>
        <message>
            <source>the pictures disagree by {residual:.1f} px: two red things, or a moved camera</source>
            <translation type="unfinished">les images diffèrent de {residual:.1f} px : deux objets rouges, ou une caméra déplacée</translation>
        </message>
        <message>
            <source>the marker seems {distance:.1f} mm beside the needle's line</source>
            <translation type="unfinished">le marqueur paraît à {distance:.1f} mm de l’axe de l’aiguille</translation>
        </message>
        <message>
            <source>{as_set_px:.1f} px as set, {swapped_px:.1f} px exchanged</source>
            <translation type="unfinished">{as_set_px:.1f} px comme réglé, {swapped_px:.1f} px inversé</translation>
        </message>
        <message>
            <source>the cameras are swapped ({figures}): exchange left and right in the settings</source>
            <translation type="unfinished">les caméras sont inversées ({figures}) : échangez gauche et droite dans les réglages</translation>
        </message>
        <message>
            <source>left and right are as calibrated ({figures})</source>
            <translation type="unfinished">gauche et droite sont comme à l’étalonnage ({figures})</translation>
        </message>
        <message>
            <source>left and right could not be checked: both must see the marker</source>
            <translation type="unfinished">gauche et droite n’ont pas pu être vérifiées : les deux caméras doivent voir le marqueur</translation>
        </message>
        <message>
            <source>the pictures fit in neither order ({figures}): calibrate again, a camera was moved or another one plugged in</source>
            <translation type="unfinished">les images ne concordent dans aucun ordre ({figures}) : refaites l’étalonnage, une caméra a été déplacée ou une autre branchée</translation>
        </message>
        <message>
            <source>left and right could not be told apart ({figures}): move the needle sideways, and deeper or further out</source>
            <translation type="unfinished">gauche et droite n’ont pas pu être distinguées ({figures}) : déplacez l’aiguille de côté, et plus profond ou plus au dehors</translation>
        </message>
        <message>
            <source>the marker is out of view of the {name} camera</source>
            <translation type="unfinished">le marqueur est hors de vue de la caméra {name}</translation>
        </message>
        <message>
            <source>the {name} camera does not measure the marker ({reason})</source>
            <translation type="unfinished">la caméra {name} ne mesure pas le marqueur ({reason})</translation>
        </message>
        <message>
            <source>the tracker needs two cameras, got {cameras}</source>
            <translation type="unfinished">le suivi demande deux caméras, reçu {cameras}</translation>
        </message>
        <message>
            <source>a step of the tracker needs at least one picture</source>
            <translation type="unfinished">un pas du suivi demande au moins une image</translation>
        </message>
        <message>
            <source>the pictures' capture times run backwards</source>
            <translation type="unfinished">les temps de prise des images vont à rebours</translation>
        </message>
        <message>
            <source>camera {camera!r} has given no picture; there are {names}</source>
            <translation type="unfinished">la caméra {camera!r} n’a donné aucune image ; il existe {names}</translation>
        </message>
        <message>
            <source>{share:.1f} % of the ticks come too late</source>
            <translation type="unfinished">{share:.1f} % des cycles arrivent trop tard</translation>
        </message>
        <message>
            <source>a tick takes {us:.0f} µs of {period:.0f} µs</source>
            <translation type="unfinished">un cycle prend {us:.0f} µs sur {period:.0f} µs</translation>
        </message>
        <message>
            <source>{what}: no effect of this scene is the reason; close other programs, or use a faster computer</source>
            <translation type="unfinished">{what} : aucun effet de cette scène n’en est la cause ; fermez d’autres programmes ou prenez un ordinateur plus rapide</translation>
        </message>
        <message>
            <source>{what}: compute “{title}” by {model}, which saves {us:.1f} µs a tick</source>
            <translation type="unfinished">{what} : calculez « {title} » par {model}, ce qui économise {us:.1f} µs par cycle</translation>
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
            <translation type="unfinished">Temps de calcul d’un appel</translation>
        </message>
        <message>
            <source>in use</source>
            <translation type="unfinished">utilisé</translation>
        </message>
        <message>
            <source>by the rule</source>
            <translation type="unfinished">selon la règle</translation>
        </message>
        <message>
            <source>Effects</source>
            <translation type="unfinished">Effets</translation>
        </message>
        <message>
            <source>&amp;Checks</source>
            <translation type="unfinished">&amp;Vérifications</translation>
        </message>
        <message>
            <source>Cost of accuracy…</source>
            <translation type="unfinished">Coût de la précision…</translation>
        </message>
        <message>
            <source>{effect} is computed by {model}</source>
            <translation type="unfinished">{effect} est calculé par {model}</translation>
        </message>
        <message>
            <source>Trying hard cases</source>
            <translation type="unfinished">Essai des cas difficiles</translation>
        </message>
        <message>
            <source>Measuring on this computer</source>
            <translation type="unfinished">Mesure sur cet ordinateur</translation>
        </message>
        <message>
            <source>End the attempt first: measuring takes processor time from it</source>
            <translation type="unfinished">Terminez d’abord l’essai : la mesure lui prendrait du temps de calcul</translation>
        </message>
        <message>
            <source>Something is being measured already: wait, or cancel it at the top</source>
            <translation type="unfinished">Une mesure est déjà en cours : attendez, ou annulez-la en haut</translation>
        </message>
        <message>
            <source>Where a formula is delicate: what is right there, how far off the program is, how far off it may be, and what happens one step beyond.</source>
            <translation type="unfinished">Là où une formule est délicate : ce qui est juste, de combien le programme s’en écarte, de combien il peut s’écarter, et ce qui se passe un pas plus loin.</translation>
        </message>
        <message>
            <source>Try them all</source>
            <translation type="unfinished">Tout essayer</translation>
        </message>
        <message>
            <source>Subsystem</source>
            <translation type="unfinished">Sous-système</translation>
        </message>
        <message>
            <source>Case</source>
            <translation type="unfinished">Cas</translation>
        </message>
        <message>
            <source>Error</source>
            <translation type="unfinished">Erreur</translation>
        </message>
        <message>
            <source>Bound</source>
            <translation type="unfinished">Borne</translation>
        </message>
        <message>
            <source>Unit</source>
            <translation type="unfinished">Unité</translation>
        </message>
        <message>
            <source>Beyond the bound</source>
            <translation type="unfinished">Au-delà de la borne</translation>
        </message>
        <message>
            <source>Holds</source>
            <translation type="unfinished">Tient</translation>
        </message>
        <message>
            <source>{times:.3g} times</source>
            <translation type="unfinished">{times:.3g} fois</translation>
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
            <translation type="unfinished">Mesuré avec cette version</translation>
        </message>
        <message>
            <source>Measured on this computer</source>
            <translation type="unfinished">Mesuré sur cet ordinateur</translation>
        </message>
        <message>
            <source>Ratios hold on every computer, seconds do not</source>
            <translation type="unfinished">Les rapports valent sur tout ordinateur, les secondes non</translation>
        </message>
        <message>
            <source>Measure on this computer</source>
            <translation type="unfinished">Mesurer sur cet ordinateur</translation>
        </message>
        <message>
            <source>Way</source>
            <translation type="unfinished">Méthode</translation>
        </message>
        <message>
            <source>Largest error</source>
            <translation type="unfinished">Erreur maximale</translation>
        </message>
        <message>
            <source>Share of what can be noticed</source>
            <translation type="unfinished">Part de ce qui se remarque</translation>
        </message>
        <message>
            <source>Time</source>
            <translation type="unfinished">Temps</translation>
        </message>
        <message>
            <source>Verdict</source>
            <translation type="unfinished">Verdict</translation>
        </message>
        <message>
            <source>Back</source>
            <translation type="unfinished">Retour</translation>
        </message>
        <message>
            <source>Cost of accuracy</source>
            <translation type="unfinished">Coût de la précision</translation>
        </message>
        <message>
            <source>Choices</source>
            <translation type="unfinished">Choix</translation>
        </message>
        <message>
            <source>Hard cases</source>
            <translation type="unfinished">Cas difficiles</translation>
        </message>
        <message>
            <source>Something is being measured: wait, or cancel it at the top</source>
            <translation type="unfinished">Une mesure est en cours : attendez, ou annulez-la en haut</translation>
        </message>
        <message>
            <source>No answer: {ways}</source>
            <translation type="unfinished">Sans réponse : {ways}</translation>
        </message>
        <message>
            <source>Measured {date}, version {version}.</source>
            <translation type="unfinished">Mesuré le {date}, version {version}.</translation>
        </message>
        <message>
            <source>In use: {name}. Exception: {why} {when}</source>
            <translation type="unfinished">Utilisé : {name}. Exception : {why} {when}</translation>
        </message>
        <message>
            <source>the cheapest method in time whose error goes unnoticed</source>
            <translation type="unfinished">la méthode la moins coûteuse, à temps, dont l’erreur passe inaperçue</translation>
        </message>
        <message>
            <source>In use: {name}, {words}. {when}</source>
            <translation type="unfinished">Utilisé : {name}, {words}. {when}</translation>
        </message>
        <message>
            <source>noticed</source>
            <translation type="unfinished">perceptible</translation>
        </message>
        <message>
            <source>too slow</source>
            <translation type="unfinished">trop lent</translation>
        </message>
        <message>
            <source>keeps both limits</source>
            <translation type="unfinished">respecte les deux limites</translation>
        </message>
        <message>
            <source>{what} {taken:.1f} of {period:.0f} ms ({share:.0f} %)</source>
            <translation type="unfinished">{what} {taken:.1f} sur {period:.0f} ms ({share:.0f} %)</translation>
        </message>
        <message>
            <source>Acts on the cameras' pictures: nothing of a tick; chosen before it begins</source>
            <translation type="unfinished">Agit sur les images des caméras : rien sur le cycle ; se choisit avant le début</translation>
        </message>
        <message>
            <source>By which model it is computed, and its time in a tick on this computer; another one applies at once</source>
            <translation type="unfinished">Le modèle qui le calcule, et son temps dans un cycle sur cet ordinateur ; un autre s’applique aussitôt</translation>
        </message>
        <message>
            <source>No exercise runs: begin one to see what it simulates.</source>
            <translation type="unfinished">Aucun exercice en cours : commencez-en un pour voir ce qu’il simule.</translation>
        </message>
        <message>
            <source>Lower it</source>
            <translation type="unfinished">Réduire</translation>
        </message>
        <message>
            <source>Computes the effect that costs most by its cheapest model, at once</source>
            <translation type="unfinished">Calcule aussitôt l’effet le plus coûteux par son modèle le plus léger</translation>
        </message>
        <message>
            <source>Error against time of every choice in the program</source>
            <translation type="unfinished">Erreur et temps de chaque choix du programme</translation>
        </message>
        <message>
            <source>A frame of the window takes</source>
            <translation type="unfinished">Une image de la fenêtre prend</translation>
        </message>
        <message>
            <source>From the newest state of the needle until all that shows it is painted</source>
            <translation type="unfinished">Du dernier état de l’aiguille jusqu’à ce que tout ce qui le montre soit dessiné</translation>
        </message>
        <message>
            <source>A pair of pictures takes</source>
            <translation type="unfinished">Une paire d’images prend</translation>
        </message>
        <message>
            <source>Finding the marker in both cameras' pictures and the needle from it</source>
            <translation type="unfinished">Trouver le marqueur sur les images des deux caméras, et en déduire l’aiguille</translation>
        </message>
        <message>
            <source>This scene has no effects.</source>
            <translation type="unfinished">Cette scène n’a pas d’effets.</translation>
        </message>
        <message>
            <source>A tick takes {tick} of {period:.0f} µs ({share:.1f} %); {effects} of it for effects</source>
            <translation type="unfinished">Un cycle prend {tick} sur {period:.0f} µs ({share:.1f} %), dont {effects} pour les effets</translation>
        </message>
        <message>
            <source>held at {rate:.0f} Hz on this computer</source>
            <translation type="unfinished">tenu à {rate:.0f} Hz sur cet ordinateur</translation>
        </message>
        <message>
            <source>Bone is in the way at {depth:.0f} mm, before the target at {length:.0f} mm: no needle reaches it. Choose another entry.</source>
            <translation type="unfinished">Un os barre le passage à {depth:.0f} mm, avant la cible à {length:.0f} mm : aucune aiguille ne l’atteint. Choisissez un autre point d’entrée.</translation>
        </message>
        <message>
            <source>Exercise</source>
            <translation type="unfinished">Exercice</translation>
        </message>
        <message>
            <source>Undo</source>
            <translation type="unfinished">Annuler</translation>
        </message>
        <message>
            <source>Redo</source>
            <translation type="unfinished">Rétablir</translation>
        </message>
        <message>
            <source>Duplicate</source>
            <translation type="unfinished">Dupliquer</translation>
        </message>
        <message>
            <source>Export…</source>
            <translation type="unfinished">Exporter…</translation>
        </message>
        <message>
            <source>Try at once</source>
            <translation type="unfinished">Essayer</translation>
        </message>
        <message>
            <source>Keep</source>
            <translation type="unfinished">Conserver</translation>
        </message>
        <message>
            <source>the trial ended without an answer</source>
            <translation type="unfinished">le test s’est terminé sans réponse</translation>
        </message>
        <message>
            <source>Plan</source>
            <translation type="unfinished">Plan</translation>
        </message>
        <message>
            <source>&amp;File</source>
            <translation type="unfinished">&amp;Fichier</translation>
        </message>
        <message>
            <source>Make an exercise from the open patient…</source>
            <translation type="unfinished">Faire un exercice du patient ouvert…</translation>
        </message>
        <message>
            <source>Change the present exercise…</source>
            <translation type="unfinished">Modifier l’exercice actuel…</translation>
        </message>
        <message>
            <source>Import an exercise…</source>
            <translation type="unfinished">Importer un exercice…</translation>
        </message>
        <message>
            <source>Export the present exercise…</source>
            <translation type="unfinished">Exporter l’exercice actuel…</translation>
        </message>
        <message>
            <source>without a title</source>
            <translation type="unfinished">sans titre</translation>
        </message>
        <message>
            <source>the exercise “{title}”, which is not kept yet</source>
            <translation type="unfinished">l’exercice « {title} », qui n’est pas encore conservé</translation>
        </message>
        <message>
            <source>Exercise not kept</source>
            <translation type="unfinished">Exercice non conservé</translation>
        </message>
        <message>
            <source>Keep {what}?</source>
            <translation type="unfinished">Conserver {what} ?</translation>
        </message>
        <message>
            <source>There is no CT open to make an exercise of: open one first.</source>
            <translation type="unfinished">Aucun CT n’est ouvert pour en faire un exercice : ouvrez-en un d’abord.</translation>
        </message>
        <message>
            <source>No exercise is open: choose one first.</source>
            <translation type="unfinished">Aucun exercice n’est ouvert : choisissez-en un d’abord.</translation>
        </message>
        <message>
            <source>{title} (copy)</source>
            <translation type="unfinished">{title} (copie)</translation>
        </message>
        <message>
            <source>Exercises that come with Acus stay as they are: this is a copy.</source>
            <translation type="unfinished">Les exercices fournis avec Acus restent tels quels : ceci est une copie.</translation>
        </message>
        <message>
            <source>There is no target in the window yet: press T, then click.</source>
            <translation type="unfinished">Il n’y a pas encore de cible dans la fenêtre : appuyez sur T, puis cliquez.</translation>
        </message>
        <message>
            <source>Path and position taken from the window.</source>
            <translation type="unfinished">Trajectoire et position reprises de la fenêtre.</translation>
        </message>
        <message>
            <source>It takes a CT that is open, and an exercise without mistakes.</source>
            <translation type="unfinished">Il faut un CT ouvert et un exercice sans erreur.</translation>
        </message>
        <message>
            <source>{count} layers along the path: {names}</source>
            <translation type="unfinished">Couches le long de la trajectoire : {count} ({names})</translation>
        </message>
        <message>
            <source>Window and slab taken from the axial pane.</source>
            <translation type="unfinished">Fenêtrage et coupe épaisse repris de la vue axiale.</translation>
        </message>
        <message>
            <source>This is a copy now; the exercise that it was made of stays as it is.</source>
            <translation type="unfinished">Ceci est maintenant une copie ; l’exercice d’origine reste tel quel.</translation>
        </message>
        <message>
            <source>An attempt is running: end it first.</source>
            <translation type="unfinished">Un essai est en cours : terminez-le d’abord.</translation>
        </message>
        <message>
            <source>The exercise is used as it is now; this does not save it.</source>
            <translation type="unfinished">L’exercice est utilisé tel qu’il est maintenant ; cela ne l’enregistre pas.</translation>
        </message>
        <message>
            <source>The exercise is now in use.</source>
            <translation type="unfinished">L’exercice est maintenant utilisé.</translation>
        </message>
        <message>
            <source>Kept as “{name}”, version {n}.</source>
            <translation type="unfinished">Conservé sous « {name} », version {n}.</translation>
        </message>
        <message>
            <source>Not checked yet: what the patient calls for. The answer comes here.</source>
            <translation type="unfinished">Pas encore vérifié : ce que le patient exige. La réponse viendra ici.</translation>
        </message>
        <message>
            <source>It cannot be checked: {reason}</source>
            <translation type="unfinished">Vérification impossible : {reason}</translation>
        </message>
        <message>
            <source>The patient calls for more: {names}.</source>
            <translation type="unfinished">Le patient exige davantage : {names}.</translation>
        </message>
        <message>
            <source>Checked: the patient calls for nothing more.</source>
            <translation type="unfinished">Vérifié : le patient n’exige rien de plus.</translation>
        </message>
        <message>
            <source>Open the CT of the exercise first: begin it.</source>
            <translation type="unfinished">Ouvrez d’abord le CT de l’exercice : commencez-le.</translation>
        </message>
        <message>
            <source>Exercises (*{suffix})</source>
            <translation type="unfinished">Exercices (*{suffix})</translation>
        </message>
        <message>
            <source>Export exercise</source>
            <translation type="unfinished">Exporter l’exercice</translation>
        </message>
        <message>
            <source>Put the CT into the file, de-identified?
Without it, it can be used where the same CT is.</source>
            <translation type="unfinished">Mettre le CT dans le fichier, dé-identifié ?
Sans lui, l’exercice sert là où se trouve le même CT.</translation>
        </message>
        <message>
            <source>Exported {name}</source>
            <translation type="unfinished">Exporté : {name}</translation>
        </message>
        <message>
            <source>Exporting the exercise</source>
            <translation type="unfinished">Exportation de l’exercice</translation>
        </message>
        <message>
            <source>Import exercise</source>
            <translation type="unfinished">Importer un exercice</translation>
        </message>
        <message>
            <source>Importing the exercise</source>
            <translation type="unfinished">Importation de l’exercice</translation>
        </message>
        <message>
            <source>{file} does not hold its CT: choose the folder of the CT that the exercise was made on</source>
            <translation type="unfinished">{file} ne contient pas son CT : choisissez le dossier du CT sur lequel l’exercice a été fait</translation>
        </message>
        <message>
            <source>Folder of the exercise's CT</source>
            <translation type="unfinished">Dossier du CT de l’exercice</translation>
        </message>
        <message>
            <source>There is another exercise of this name.
Yes: keep this one as a new version of it.
No: keep it under another name.</source>
            <translation type="unfinished">Il existe un autre exercice de ce nom.
Oui : conserver celui-ci comme nouvelle version.
Non : le conserver sous un autre nom.</translation>
        </message>
        <message>
            <source>The exercise “{title}” was there already.</source>
            <translation type="unfinished">L’exercice « {title} » était déjà là.</translation>
        </message>
        <message>
            <source>The exercise “{title}” is in the list now.</source>
            <translation type="unfinished">L’exercice « {title} » est maintenant dans la liste.</translation>
        </message>
        <message>
            <source>five scripted skills are trying it …</source>
            <translation type="unfinished">cinq scripts d’habileté différente l’essaient …</translation>
        </message>
        <message>
            <source>1 attempt of each skill, without structures of risk</source>
            <translation type="unfinished">1 essai par script, sans structures à risque</translation>
        </message>
        <message>
            <source>{n} attempts of each skill, without structures of risk</source>
            <translation type="unfinished">{n} essais par script, sans structures à risque</translation>
        </message>
        <message>
            <source>more are on their way …</source>
            <translation type="unfinished">d’autres arrivent …</translation>
        </message>
        <message>
            <source>It cannot be tried: {why}</source>
            <translation type="unfinished">Impossible de l’essayer : {why}</translation>
        </message>
        <message>
            <source>Follow the path</source>
            <translation type="unfinished">Suivre la trajectoire</translation>
        </message>
        <message>
            <source>Plan it yourself</source>
            <translation type="unfinished">Planifier soi-même</translation>
        </message>
        <message>
            <source>Control scans</source>
            <translation type="unfinished">Scans de contrôle</translation>
        </message>
        <message>
            <source>Title</source>
            <translation type="unfinished">Titre</translation>
        </message>
        <message>
            <source>one line for people</source>
            <translation type="unfinished">une ligne pour les lecteurs</translation>
        </message>
        <message>
            <source>Type</source>
            <translation type="unfinished">Type</translation>
        </message>
        <message>
            <source>Level (1 easiest)</source>
            <translation type="unfinished">Niveau (1 : le plus facile)</translation>
        </message>
        <message>
            <source>Briefing</source>
            <translation type="unfinished">Consignes</translation>
        </message>
        <message>
            <source>Practice</source>
            <translation type="unfinished">Entraînement</translation>
        </message>
        <message>
            <source>Assessment: all controls are locked</source>
            <translation type="unfinished">Évaluation : toutes les commandes sont verrouillées</translation>
        </message>
        <message>
            <source>Purpose</source>
            <translation type="unfinished">But</translation>
        </message>
        <message>
            <source>Will be kept as “{name}”.</source>
            <translation type="unfinished">Sera conservé sous « {name} ».</translation>
        </message>
        <message>
            <source>; changes become the next version</source>
            <translation type="unfinished">; les changements deviendront la version suivante</translation>
        </message>
        <message>
            <source>Kept as “{name}”, version {n}</source>
            <translation type="unfinished">Conservé sous « {name} », version {n}</translation>
        </message>
        <message>
            <source>Patient and path</source>
            <translation type="unfinished">Patient et trajectoire</translation>
        </message>
        <message>
            <source>Take path and position from the window</source>
            <translation type="unfinished">Reprendre trajectoire et position de la fenêtre</translation>
        </message>
        <message>
            <source>Structure</source>
            <translation type="unfinished">Structure</translation>
        </message>
        <message>
            <source>Of risk</source>
            <translation type="unfinished">À risque</translation>
        </message>
        <message>
            <source>Keep off [mm]</source>
            <translation type="unfinished">Distance [mm]</translation>
        </message>
        <message>
            <source>None is drawn: draw or import some on the page Structures.</source>
            <translation type="unfinished">Aucune n’est dessinée : dessinez-en ou importez-en à la page Structures.</translation>
        </message>
        <message>
            <source>Structures, drawn in the window</source>
            <translation type="unfinished">Structures dessinées dans la fenêtre</translation>
        </message>
        <message>
            <source>Needle</source>
            <translation type="unfinished">Aiguille</translation>
        </message>
        <message>
            <source>Length of the needle, 0 for the device's own</source>
            <translation type="unfinished">Longueur de l’aiguille, 0 pour celle de l’appareil</translation>
        </message>
        <message>
            <source>Robot</source>
            <translation type="unfinished">Robot</translation>
        </message>
        <message>
            <source>Ball joint, empty for the robot's own</source>
            <translation type="unfinished">Rotule, vide pour celle du robot</translation>
        </message>
        <message>
            <source>Cameras</source>
            <translation type="unfinished">Caméras</translation>
        </message>
        <message>
            <source>Organ of the target</source>
            <translation type="unfinished">Organe de la cible</translation>
        </message>
        <message>
            <source>such as liver</source>
            <translation type="unfinished">par exemple liver</translation>
        </message>
        <message>
            <source>Seed of everything random</source>
            <translation type="unfinished">Graine de tout l’aléatoire</translation>
        </message>
        <message>
            <source>Phantom {n}</source>
            <translation type="unfinished">Fantôme {n}</translation>
        </message>
        <message>
            <source>Own CT, digest {digest}…</source>
            <translation type="unfinished">Votre CT, empreinte {digest}…</translation>
        </message>
        <message>
            <source>Own CT</source>
            <translation type="unfinished">Votre CT</translation>
        </message>
        <message>
            <source>Entry</source>
            <translation type="unfinished">Point d’entrée</translation>
        </message>
        <message>
            <source>Target</source>
            <translation type="unfinished">Cible</translation>
        </message>
        <message>
            <source>the student's to place</source>
            <translation type="unfinished">à placer par l’étudiant</translation>
        </message>
        <message>
            <source>the phantom's lesion</source>
            <translation type="unfinished">la lésion du fantôme</translation>
        </message>
        <message>
            <source>Position: {name}</source>
            <translation type="unfinished">Position : {name}</translation>
        </message>
        <message>
            <source>Assistance</source>
            <translation type="unfinished">Assistance</translation>
        </message>
        <message>
            <source>Dial at the start: 1 guides, 0 nothing, −1 repels</source>
            <translation type="unfinished">Réglage au début : 1 guide, 0 rien, −1 repousse</translation>
        </message>
        <message>
            <source>Fixed: the same at every attempt</source>
            <translation type="unfinished">Fixe : la même à chaque essai</translation>
        </message>
        <message>
            <source>Schedule: a dial for each attempt</source>
            <translation type="unfinished">Programme : un réglage par essai</translation>
        </message>
        <message>
            <source>Fading: less after good attempts, more after poor ones</source>
            <translation type="unfinished">Dégressive : moins après de bons essais, plus après de mauvais</translation>
        </message>
        <message>
            <source>Over the attempts</source>
            <translation type="unfinished">Au fil des essais</translation>
        </message>
        <message>
            <source>Dials of the 1st, 2nd, … attempt</source>
            <translation type="unfinished">Réglages des 1er, 2e, … essais</translation>
        </message>
        <message>
            <source>Dial never falls below</source>
            <translation type="unfinished">Réglage jamais inférieur à</translation>
        </message>
        <message>
            <source>Step of the dial</source>
            <translation type="unfinished">Pas du réglage</translation>
        </message>
        <message>
            <source>Good from a total of</source>
            <translation type="unfinished">Bon à partir d’un total de</translation>
        </message>
        <message>
            <source>Poor below a total of</source>
            <translation type="unfinished">Mauvais sous un total de</translation>
        </message>
        <message>
            <source>Every so many attempts a probe without help; 0: none</source>
            <translation type="unfinished">Tous les tant d’essais, un essai témoin sans aide ; 0 : aucun</translation>
        </message>
        <message>
            <source>Force laws</source>
            <translation type="unfinished">Lois de force</translation>
        </message>
        <message>
            <source>What is seen</source>
            <translation type="unfinished">Ce qui est visible</translation>
        </message>
        <message>
            <source>Views</source>
            <translation type="unfinished">Vues</translation>
        </message>
        <message>
            <source>The assistance</source>
            <translation type="unfinished">L’assistance</translation>
        </message>
        <message>
            <source>What is shown</source>
            <translation type="unfinished">Ce qui est affiché</translation>
        </message>
        <message>
            <source>Window, slab and layout</source>
            <translation type="unfinished">Fenêtrage, coupe épaisse et disposition</translation>
        </message>
        <message>
            <source>What moves the hand</source>
            <translation type="unfinished">Ce qui déplace la main</translation>
        </message>
        <message>
            <source>The way effects are computed</source>
            <translation type="unfinished">La façon de calculer les effets</translation>
        </message>
        <message>
            <source>Locked for the student</source>
            <translation type="unfinished">Verrouillé pour l’étudiant</translation>
        </message>
        <message>
            <source>The student's own</source>
            <translation type="unfinished">Au choix de l’étudiant</translation>
        </message>
        <message>
            <source>Mouse</source>
            <translation type="unfinished">Souris</translation>
        </message>
        <message>
            <source>Tablet</source>
            <translation type="unfinished">Tablette</translation>
        </message>
        <message>
            <source>Gamepad</source>
            <translation type="unfinished">Manette</translation>
        </message>
        <message>
            <source>Hand</source>
            <translation type="unfinished">Main</translation>
        </message>
        <message>
            <source>As the exercise's level has it</source>
            <translation type="unfinished">Selon le niveau de l’exercice</translation>
        </message>
        <message>
            <source>Steady</source>
            <translation type="unfinished">Stable</translation>
        </message>
        <message>
            <source>Unsteady as at level {n}</source>
            <translation type="unfinished">Instable comme au niveau {n}</translation>
        </message>
        <message>
            <source>Simulated hand</source>
            <translation type="unfinished">Main simulée</translation>
        </message>
        <message>
            <source>Window of the CT</source>
            <translation type="unfinished">Fenêtrage du CT</translation>
        </message>
        <message>
            <source>Along the needle</source>
            <translation type="unfinished">Le long de l’aiguille</translation>
        </message>
        <message>
            <source>Layout of the panes</source>
            <translation type="unfinished">Disposition des vues</translation>
        </message>
        <message>
            <source>Mean</source>
            <translation type="unfinished">Moyenne</translation>
        </message>
        <message>
            <source>Brightest</source>
            <translation type="unfinished">Plus clair</translation>
        </message>
        <message>
            <source>Darkest</source>
            <translation type="unfinished">Plus sombre</translation>
        </message>
        <message>
            <source>Slab</source>
            <translation type="unfinished">Coupe épaisse</translation>
        </message>
        <message>
            <source>Thickness of the slab</source>
            <translation type="unfinished">Épaisseur de la coupe épaisse</translation>
        </message>
        <message>
            <source>Take window and slab from the axial pane</source>
            <translation type="unfinished">Reprendre fenêtrage et coupe épaisse de la vue axiale</translation>
        </message>
        <message>
            <source>Window, slab and layout stay as given here</source>
            <translation type="unfinished">Fenêtrage, coupe épaisse et disposition restent tels qu’ici</translation>
        </message>
        <message>
            <source>Slices of a control scan</source>
            <translation type="unfinished">Coupes d’un scan de contrôle</translation>
        </message>
        <message>
            <source>Thickness of a slice</source>
            <translation type="unfinished">Épaisseur d’une coupe</translation>
        </message>
        <message>
            <source>Dose of a slice, a teaching estimate</source>
            <translation type="unfinished">Dose d’une coupe, estimation pédagogique</translation>
        </message>
        <message>
            <source>Metal leaves a streak in control scans</source>
            <translation type="unfinished">Le métal laisse une strie dans les scans de contrôle</translation>
        </message>
        <message>
            <source>Not shown: the needle is seen on control scans alone</source>
            <translation type="unfinished">Non affiché : l’aiguille n’est visible que sur les scans de contrôle</translation>
        </message>
        <message>
            <source>Where control scans guide, the assistance is the exercise's own</source>
            <translation type="unfinished">Là où les scans de contrôle guident, l’assistance est celle de l’exercice</translation>
        </message>
        <message>
            <source>An assessment locks all of them</source>
            <translation type="unfinished">Une évaluation les verrouille tous</translation>
        </message>
        <message>
            <source>Layers of tissue, from the skin inwards</source>
            <translation type="unfinished">Couches de tissu, de la peau vers l’intérieur</translation>
        </message>
        <message>
            <source>Where they come from</source>
            <translation type="unfinished">D’où elles viennent</translation>
        </message>
        <message>
            <source>this table</source>
            <translation type="unfinished">ce tableau</translation>
        </message>
        <message>
            <source>the CT along the path, found when an attempt begins</source>
            <translation type="unfinished">le CT le long de la trajectoire, lu au début d’un essai</translation>
        </message>
        <message>
            <source>Add what is absent</source>
            <translation type="unfinished">Ajouter ce qui manque</translation>
        </message>
        <message>
            <source>measuring what it costs …</source>
            <translation type="unfinished">mesure du coût …</translation>
        </message>
        <message>
            <source>{name}: {ns:.0f} ns of each tick</source>
            <translation type="unfinished">{name} : {ns:.0f} ns par cycle</translation>
        </message>
        <message>
            <source>together {share:.2f} % of the millisecond that a tick has</source>
            <translation type="unfinished">au total {share:.2f} % de la milliseconde dont dispose un cycle</translation>
        </message>
        <message>
            <source>{name}: {ms:.2f} ms for each picture of a camera</source>
            <translation type="unfinished">{name} : {ms:.2f} ms par image de caméra</translation>
        </message>
        <message>
            <source>It cannot be measured: {reason}</source>
            <translation type="unfinished">Mesure impossible : {reason}</translation>
        </message>
        <message>
            <source>✖ {name} is called for: {reason} ({ns:.0f} ns of each tick)</source>
            <translation type="unfinished">✖ {name} est nécessaire : {reason} ({ns:.0f} ns par cycle)</translation>
        </message>
        <message>
            <source>None is given: the body is of one tissue.</source>
            <translation type="unfinished">Aucune n’est donnée : le corps est fait d’un seul tissu.</translation>
        </message>
        <message>
            <source>Layer</source>
            <translation type="unfinished">Couche</translation>
        </message>
        <message>
            <source>thick
[mm]</source>
            <translation type="unfinished">épaisseur
[mm]</translation>
        </message>
        <message>
            <source>side stiffness
[kPa]</source>
            <translation type="unfinished">raideur latérale
[kPa]</translation>
        </message>
        <message>
            <source>friction
[N/m]</source>
            <translation type="unfinished">frottement
[N/m]</translation>
        </message>
        <message>
            <source>break-away
[N/m]</source>
            <translation type="unfinished">décollement
[N/m]</translation>
        </message>
        <message>
            <source>viscous
[N·s/m²]</source>
            <translation type="unfinished">visqueux
[N·s/m²]</translation>
        </message>
        <message>
            <source>puncture,
18 G [N]</source>
            <translation type="unfinished">perforation,
18 G [N]</translation>
        </message>
        <message>
            <source>toughness
[J/m²]</source>
            <translation type="unfinished">ténacité
[J/m²]</translation>
        </message>
        <message>
            <source>dimple
[N/m]</source>
            <translation type="unfinished">enfoncement
[N/m]</translation>
        </message>
        <message>
            <source>dimple
[N/m²]</source>
            <translation type="unfinished">enfoncement
[N/m²]</translation>
        </message>
        <message>
            <source>relaxing
share</source>
            <translation type="unfinished">relaxation
part</translation>
        </message>
        <message>
            <source>relaxing
[s]</source>
            <translation type="unfinished">relaxation
[s]</translation>
        </message>
        <message>
            <source>bone</source>
            <translation type="unfinished">os</translation>
        </message>
        <message>
            <source>Add a layer</source>
            <translation type="unfinished">Ajouter une couche</translation>
        </message>
        <message>
            <source>Remove</source>
            <translation type="unfinished">Supprimer</translation>
        </message>
        <message>
            <source>Outwards</source>
            <translation type="unfinished">Vers l’extérieur</translation>
        </message>
        <message>
            <source>Inwards</source>
            <translation type="unfinished">Vers l’intérieur</translation>
        </message>
        <message>
            <source>From the CT</source>
            <translation type="unfinished">D’après le CT</translation>
        </message>
        <message>
            <source>Fills the table with what the needle meets on its path.</source>
            <translation type="unfinished">Remplit le tableau avec ce que l’aiguille rencontre sur sa trajectoire.</translation>
        </message>
        <message>
            <source>yes</source>
            <translation type="unfinished">oui</translation>
        </message>
        <message>
            <source>everything</source>
            <translation type="unfinished">tout</translation>
        </message>
        <message>
            <source>acts on</source>
            <translation type="unfinished">agit sur</translation>
        </message>
        <message>
            <source>computed by</source>
            <translation type="unfinished">calculé par</translation>
        </message>
        <message>
            <source>What scripted skills would score</source>
            <translation type="unfinished">Ce qu’obtiendraient des scripts d’habileté différente</translation>
        </message>
        <message>
            <source>pass</source>
            <translation type="unfinished">réussi</translation>
        </message>
        <message>
            <source>Score</source>
            <translation type="unfinished">Note</translation>
        </message>
        <message>
            <source>Counts</source>
            <translation type="unfinished">Compte</translation>
        </message>
        <message>
            <source>expert</source>
            <translation type="unfinished">expert</translation>
        </message>
        <message>
            <source>good</source>
            <translation type="unfinished">bon</translation>
        </message>
        <message>
            <source>zero</source>
            <translation type="unfinished">zéro</translation>
        </message>
        <message>
            <source>weight</source>
            <translation type="unfinished">poids</translation>
        </message>
        <message>
            <source>must</source>
            <translation type="unfinished">requis</translation>
        </message>
        <message>
            <source>Bands: from “expert” on all points, beyond “zero” none</source>
            <translation type="unfinished">Paliers : à « expert » tous les points, au-delà de « zéro » aucun</translation>
        </message>
        <message>
            <source>Total needed to pass</source>
            <translation type="unfinished">Total requis pour réussir</translation>
        </message>
        <message>
            <source>Void below this share of the insertion with a measured depth</source>
            <translation type="unfinished">Nul sous cette part de la ponction à profondeur mesurée</translation>
        </message>
        <message>
            <source>Void beyond this time of waiting for the cameras</source>
            <translation type="unfinished">Nul au-delà de ce temps d’attente des caméras</translation>
        </message>
        <message>
            <source>The rings of “Off the path” are drawn on the CT as you change them.</source>
            <translation type="unfinished">Les anneaux de « Écart latéral » se dessinent sur le CT à mesure que vous les changez.</translation>
        </message>
        <message>
            <source>Check and keep</source>
            <translation type="unfinished">Vérifier et conserver</translation>
        </message>
        <message>
            <source>File of the exercise</source>
            <translation type="unfinished">Fichier de l’exercice</translation>
        </message>
        <message>
            <source>▲ The exercise can be used, but: {why}</source>
            <translation type="unfinished">▲ L’exercice est utilisable, mais : {why}</translation>
        </message>
        <message>
            <source>✔ The exercise can be used.</source>
            <translation type="unfinished">✔ L’exercice est utilisable.</translation>
        </message>
        <message>
            <source>Calibration board {spec}</source>
            <translation type="unfinished">Mire d’étalonnage {spec}</translation>
        </message>
        <message>
            <source>Print at 100 %, not fitted to the page. The line above measures 100 mm: check it. Glue the sheet on something flat.</source>
            <translation type="unfinished">Imprimez à 100 %, sans ajuster à la page. La ligne ci-dessus mesure 100 mm : vérifiez-le. Collez la feuille sur un support plan.</translation>
        </message>
        <message>
            <source>Simulated</source>
            <translation type="unfinished">Simulée</translation>
        </message>
        <message>
            <source>A camera that is plugged in, or typed: usb:PORT, folder:PATH, video:PATH</source>
            <translation type="unfinished">Une caméra branchée, ou une saisie : usb:PORT, folder:PATH, video:PATH</translation>
        </message>
        <message>
            <source>Aim the cameras</source>
            <translation type="unfinished">Orienter les caméras</translation>
        </message>
        <message>
            <source>Left</source>
            <translation type="unfinished">Gauche</translation>
        </message>
        <message>
            <source>Right</source>
            <translation type="unfinished">Droite</translation>
        </message>
        <message>
            <source>Computing the cone</source>
            <translation type="unfinished">Calcul du cône</translation>
        </message>
        <message>
            <source>{symbol} Standing as designed, both cameras would see {share:.0f} % of the cone</source>
            <translation type="unfinished">{symbol} Placées comme prévu, les deux caméras verraient {share:.0f} % du cône</translation>
        </message>
        <message>
            <source>{symbol} Both cameras see {share:.0f} % of the needle's cone</source>
            <translation type="unfinished">{symbol} Les deux caméras voient {share:.0f} % du cône de l’aiguille</translation>
        </message>
        <message>
            <source>{name}: would see {share:.0f} %</source>
            <translation type="unfinished">{name} : verrait {share:.0f} %</translation>
        </message>
        <message>
            <source>{name}: sees {share:.0f} %</source>
            <translation type="unfinished">{name} : voit {share:.0f} %</translation>
        </message>
        <message>
            <source>Cone of: {basis}.</source>
            <translation type="unfinished">Base du cône : {basis}.</translation>
        </message>
        <message>
            <source>The green line surrounds every place the marker can be at. It should lie within both pictures. The line follows from the calibration, not from the picture: after moving a camera, calibrate again.</source>
            <translation type="unfinished">La ligne verte entoure tous les endroits où peut se trouver le marqueur. Elle doit tenir dans les deux images. Elle vient de l’étalonnage, non de l’image : après avoir bougé une caméra, refaites l’étalonnage.</translation>
        </message>
        <message>
            <source>&amp;Cameras</source>
            <translation type="unfinished">&amp;Caméras</translation>
        </message>
        <message>
            <source>the cameras</source>
            <translation type="unfinished">les caméras</translation>
        </message>
        <message>
            <source>Only simulated cameras are chosen, which need no aiming and have no latency: choose real ones in the menu Cameras, Set up.</source>
            <translation type="unfinished">Seules des caméras simulées sont choisies ; elles ne s’orientent pas et n’ont pas de latence : choisissez-en de vraies dans le menu Caméras, Configurer.</translation>
        </message>
        <message>
            <source>Simulated cameras</source>
            <translation type="unfinished">Caméras simulées</translation>
        </message>
        <message>
            <source>Set up…</source>
            <translation type="unfinished">Configurer…</translation>
        </message>
        <message>
            <source>Aim…</source>
            <translation type="unfinished">Orienter…</translation>
        </message>
        <message>
            <source>Calibrate…</source>
            <translation type="unfinished">Étalonner…</translation>
        </message>
        <message>
            <source>Latency</source>
            <translation type="unfinished">Latence</translation>
        </message>
        <message>
            <source>Measure how late a picture arrives: a patch blinks, the camera watches it, the delay is saved</source>
            <translation type="unfinished">Mesure le retard d’une image : un carré clignote, la caméra le regarde, le retard est enregistré</translation>
        </message>
        <message>
            <source>Which cameras there are: size, rate, exposure, live pictures</source>
            <translation type="unfinished">Les caméras présentes : taille, cadence, exposition, images en direct</translation>
        </message>
        <message>
            <source>Where the needle can be, drawn into both live pictures</source>
            <translation type="unfinished">Où peut se trouver l’aiguille, dessiné dans les deux images en direct</translation>
        </message>
        <message>
            <source>Lenses and places of the cameras, from pictures of a board</source>
            <translation type="unfinished">Objectifs et positions des caméras, d’après des images d’une mire</translation>
        </message>
        <message>
            <source>Left camera…</source>
            <translation type="unfinished">Caméra gauche…</translation>
        </message>
        <message>
            <source>Right camera…</source>
            <translation type="unfinished">Caméra droite…</translation>
        </message>
        <message>
            <source>Real cameras: choose…</source>
            <translation type="unfinished">Vraies caméras : choisir…</translation>
        </message>
        <message>
            <source>Real cameras: {left}, {right}</source>
            <translation type="unfinished">Vraies caméras : {left}, {right}</translation>
        </message>
        <message>
            <source>left</source>
            <translation type="unfinished">gauche</translation>
        </message>
        <message>
            <source>right</source>
            <translation type="unfinished">droite</translation>
        </message>
        <message>
            <source>Latency of the {name} camera</source>
            <translation type="unfinished">Latence de la caméra {name}</translation>
        </message>
        <message>
            <source>Start</source>
            <translation type="unfinished">Démarrer</translation>
        </message>
        <message>
            <source>measuring: leave camera and window where they are</source>
            <translation type="unfinished">mesure en cours : ne bougez ni la caméra ni la fenêtre</translation>
        </message>
        <message>
            <source>the camera was lost; start again</source>
            <translation type="unfinished">caméra perdue ; recommencez</translation>
        </message>
        <message>
            <source>From the screen to the delivered picture: {value}</source>
            <translation type="unfinished">De l’écran à l’image livrée : {value}</translation>
        </message>
        <message>
            <source>Point the camera at the patch, a hand's breadth away, so that the patch fills a good part of the picture. The patch blinks at random for {seconds:.0f} s. The result contains the screen's own delay, usually one or two of its pictures (10 to 30 ms).</source>
            <translation type="unfinished">Pointez la caméra vers le carré, à une largeur de main, pour qu’il remplisse une bonne partie de l’image. Il clignote au hasard pendant {seconds:.0f} s. Le résultat inclut le retard propre à l’écran, en général une ou deux de ses images (10 à 30 ms).</translation>
        </message>
        <message>
            <source>no picture</source>
            <translation type="unfinished">pas d’image</translation>
        </message>
        <message>
            <source>opening the camera …</source>
            <translation type="unfinished">ouverture de la caméra …</translation>
        </message>
        <message>
            <source>Opening the camera</source>
            <translation type="unfinished">Ouverture de la caméra</translation>
        </message>
        <message>
            <source>opening the camera: {what}</source>
            <translation type="unfinished">ouverture de la caméra : {what}</translation>
        </message>
        <message>
            <source>{rate:.0f} pictures/s, jitter {jitter:.1f} ms</source>
            <translation type="unfinished">{rate:.0f} images/s, gigue {jitter:.1f} ms</translation>
        </message>
        <message>
            <source> ms</source>
            <translation type="unfinished"> ms</translation>
        </message>
        <message>
            <source>as the camera finds it, then held</source>
            <translation type="unfinished">celle que trouve la caméra, puis maintenue</translation>
        </message>
        <message>
            <source>Source</source>
            <translation type="unfinished">Source</translation>
        </message>
        <message>
            <source>Exposure</source>
            <translation type="unfinished">Exposition</translation>
        </message>
        <message>
            <source>Left camera</source>
            <translation type="unfinished">Caméra gauche</translation>
        </message>
        <message>
            <source>Right camera</source>
            <translation type="unfinished">Caméra droite</translation>
        </message>
        <message>
            <source>Exchange left and right</source>
            <translation type="unfinished">Échanger gauche et droite</translation>
        </message>
        <message>
            <source>simulated: nothing to set up</source>
            <translation type="unfinished">simulée : rien à configurer</translation>
        </message>
        <message>
            <source> per second</source>
            <translation type="unfinished"> par seconde</translation>
        </message>
        <message>
            <source>Left and right are as seen from the side on which the cameras stand. Hold a hand before one camera: its picture must be the one below its name.</source>
            <translation type="unfinished">Gauche et droite s’entendent du côté où se trouvent les caméras. Mettez une main devant une caméra : son image doit être celle sous son nom.</translation>
        </message>
        <message>
            <source>No camera is plugged in. Plug both in, then open this dialog again; a folder or a video can be typed as source: folder:PATH, video:PATH.</source>
            <translation type="unfinished">Aucune caméra n’est branchée. Branchez les deux, puis rouvrez cette fenêtre ; un dossier ou une vidéo peut aussi être saisi comme source : folder:PATH, video:PATH.</translation>
        </message>
        <message>
            <source>Size</source>
            <translation type="unfinished">Taille</translation>
        </message>
        <message>
            <source>Pictures</source>
            <translation type="unfinished">Images</translation>
        </message>
        <message>
            <source>Save as PDF to print…</source>
            <translation type="unfinished">Enregistrer en PDF à imprimer…</translation>
        </message>
        <message>
            <source>Board</source>
            <translation type="unfinished">Mire</translation>
        </message>
        <message>
            <source>written to {file}: print it at 100 % and measure the line of 100 mm</source>
            <translation type="unfinished">écrit dans {file} : imprimez à 100 % et mesurez la ligne de 100 mm</translation>
        </message>
        <message>
            <source>Squares</source>
            <translation type="unfinished">Carrés</translation>
        </message>
        <message>
            <source>Inner corners</source>
            <translation type="unfinished">Coins intérieurs</translation>
        </message>
        <message>
            <source>{why}. A board that you have already can be used all the same.</source>
            <translation type="unfinished">{why}. Une mire que vous avez déjà peut tout de même servir.</translation>
        </message>
        <message>
            <source>This board looks the same after half a turn. The program mends what it can; a ChArUco board needs no mending.</source>
            <translation type="unfinished">Cette mire est identique après un demi-tour. Le programme corrige ce qu’il peut ; une mire ChArUco n’en a pas besoin.</translation>
        </message>
        <message>
            <source>{w:.0f} × {h:.0f} mm</source>
            <translation type="unfinished">{w:.0f} × {h:.0f} mm</translation>
        </message>
        <message>
            <source>Save the board</source>
            <translation type="unfinished">Enregistrer la mire</translation>
        </message>
        <message>
            <source>PDF (*.pdf)</source>
            <translation type="unfinished">PDF (*.pdf)</translation>
        </message>
        <message>
            <source>ChArUco (recommended)</source>
            <translation type="unfinished">ChArUco (recommandée)</translation>
        </message>
        <message>
            <source>Checkerboard</source>
            <translation type="unfinished">Damier</translation>
        </message>
        <message>
            <source>Which board do you have?</source>
            <translation type="unfinished">Quelle mire avez-vous ?</translation>
        </message>
        <message>
            <source>A flat board with squares of a known size. ChArUco may be seen in part and always says which way round it lies.</source>
            <translation type="unfinished">Une mire plane à carrés de taille connue. ChArUco peut n’être vue qu’en partie et indique toujours son orientation.</translation>
        </message>
        <message>
            <source>Measure the line of 100 mm below the board, and type the squares as they are: a print at 97 % leaves every residual as good as it was, and makes all that is measured 3 % too long.</source>
            <translation type="unfinished">Mesurez la ligne de 100 mm sous la mire, et saisissez les carrés tels qu’ils sont : une impression à 97 % laisse chaque résidu aussi bon, et allonge de 3 % tout ce qui est mesuré.</translation>
        </message>
        <message>
            <source>Kind</source>
            <translation type="unfinished">Type</translation>
        </message>
        <message>
            <source>Side of a square</source>
            <translation type="unfinished">Côté d’un carré</translation>
        </message>
        <message>
            <source>Side of a marker</source>
            <translation type="unfinished">Côté d’un marqueur</translation>
        </message>
        <message>
            <source>Markers</source>
            <translation type="unfinished">Marqueurs</translation>
        </message>
        <message>
            <source>Paper</source>
            <translation type="unfinished">Papier</translation>
        </message>
        <message>
            <source>Calibration of the cameras</source>
            <translation type="unfinished">Étalonnage des caméras</translation>
        </message>
        <message>
            <source>Choose a board that can be</source>
            <translation type="unfinished">Choisissez une mire possible</translation>
        </message>
        <message>
            <source>Take or open pictures first. To place or to import a calibration without any, choose the page in the list.</source>
            <translation type="unfinished">Prenez ou ouvrez d’abord des images. Pour placer ou importer un étalonnage sans image, choisissez la page dans la liste.</translation>
        </message>
        <message>
            <source>There is no result yet</source>
            <translation type="unfinished">Il n’y a pas encore de résultat</translation>
        </message>
        <message>
            <source>Unsaved calibration</source>
            <translation type="unfinished">Étalonnage non enregistré</translation>
        </message>
        <message>
            <source>Pictures and calibration are not saved and will be lost. Close all the same?</source>
            <translation type="unfinished">Les images et l’étalonnage ne sont pas enregistrés et seront perdus. Fermer quand même ?</translation>
        </message>
        <message>
            <source>{camera}: {n} different views, {share} % covered</source>
            <translation type="unfinished">{camera} : vues différentes : {n}, {share} % couverts</translation>
        </message>
        <message>
            <source>no picture yet</source>
            <translation type="unfinished">pas encore d’image</translation>
        </message>
        <message>
            <source>Begin with the live cameras</source>
            <translation type="unfinished">Commencer avec les caméras</translation>
        </message>
        <message>
            <source>Pictures of a folder…</source>
            <translation type="unfinished">Images d’un dossier…</translation>
        </message>
        <message>
            <source>Stop</source>
            <translation type="unfinished">Arrêter</translation>
        </message>
        <message>
            <source>Drop the last</source>
            <translation type="unfinished">Retirer la dernière</translation>
        </message>
        <message>
            <source>opening the cameras …</source>
            <translation type="unfinished">ouverture des caméras …</translation>
        </message>
        <message>
            <source>Choose real cameras in the menu Cameras first</source>
            <translation type="unfinished">Choisissez d’abord de vraies caméras dans le menu Caméras</translation>
        </message>
        <message>
            <source>No pictures yet.</source>
            <translation type="unfinished">Pas encore d’images.</translation>
        </message>
        <message>
            <source>looking for the board …</source>
            <translation type="unfinished">recherche de la mire …</translation>
        </message>
        <message>
            <source>✔ There are enough views: go on, or take more.</source>
            <translation type="unfinished">✔ Il y a assez de vues : continuez, ou prenez-en d’autres.</translation>
        </message>
        <message>
            <source>Folder of the pictures</source>
            <translation type="unfinished">Dossier des images</translation>
        </message>
        <message>
            <source>Show the board to both cameras</source>
            <translation type="unfinished">Montrez la mire aux deux caméras</translation>
        </message>
        <message>
            <source>Hold it still for a moment, then move it on: near and far, to every corner of the pictures, tilted to all sides. A useful picture is taken by itself. From a folder, pictures are paired by name: left01.png with right01.png.</source>
            <translation type="unfinished">Tenez-la immobile un instant, puis déplacez-la : près et loin, dans chaque coin des images, inclinée de tous côtés. Une image utile est prise d’elle-même. Dans un dossier, les images sont associées par nom : left01.png avec right01.png.</translation>
        </message>
        <message>
            <source>Take it with the cameras</source>
            <translation type="unfinished">Relever avec les caméras</translation>
        </message>
        <message>
            <source>Drop all places</source>
            <translation type="unfinished">Retirer toutes les positions</translation>
        </message>
        <message>
            <source>Place</source>
            <translation type="unfinished">Position</translation>
        </message>
        <message>
            <source>for calibration {id}</source>
            <translation type="unfinished">pour l’étalonnage {id}</translation>
        </message>
        <message>
            <source>world frame found from one place; another place makes it better</source>
            <translation type="unfinished">repère monde trouvé d’après une position ; une autre l’améliore</translation>
        </message>
        <message>
            <source>world frame found from {n} places</source>
            <translation type="unfinished">repère monde trouvé d’après {n} positions</translation>
        </message>
        <message>
            <source>cancelled</source>
            <translation type="unfinished">annulé</translation>
        </message>
        <message>
            <source>Pictures of the board at this place</source>
            <translation type="unfinished">Images de la mire à cette position</translation>
        </message>
        <message>
            <source>Lay the board at a known place</source>
            <translation type="unfinished">Posez la mire à un endroit connu</translation>
        </message>
        <message>
            <source>The place is that of the first inner corner, in the robot's frame: origin midway between the motor axes, x to the right motor, z up. Turned by 180° about x the board lies print up with its columns along x. Several places are better than one.</source>
            <translation type="unfinished">La position est celle du premier coin intérieur, dans le repère du robot : origine à mi-chemin des axes des moteurs, x vers le moteur droit, z vers le haut. Tournée de 180° autour de x, la mire est face imprimée vers le haut, ses colonnes le long de x. Plusieurs positions valent mieux qu’une.</translation>
        </message>
        <message>
            <source>about x</source>
            <translation type="unfinished">autour de x</translation>
        </message>
        <message>
            <source>about y</source>
            <translation type="unfinished">autour de y</translation>
        </message>
        <message>
            <source>about z</source>
            <translation type="unfinished">autour de z</translation>
        </message>
        <message>
            <source>Compute again</source>
            <translation type="unfinished">Recalculer</translation>
        </message>
        <message>
            <source>Cancel</source>
            <translation type="unfinished">Annuler</translation>
        </message>
        <message>
            <source>Pair</source>
            <translation type="unfinished">Paire</translation>
        </message>
        <message>
            <source>px</source>
            <translation type="unfinished">px</translation>
        </message>
        <message>
            <source>Remark</source>
            <translation type="unfinished">Remarque</translation>
        </message>
        <message>
            <source>Parameter</source>
            <translation type="unfinished">Paramètre</translation>
        </message>
        <message>
            <source>Result</source>
            <translation type="unfinished">Résultat</translation>
        </message>
        <message>
            <source>computing …</source>
            <translation type="unfinished">calcul en cours …</translation>
        </message>
        <message>
            <source>There are no pictures yet.</source>
            <translation type="unfinished">Il n’y a pas encore d’images.</translation>
        </message>
        <message>
            <source>Not to be used: a measured length contradicts it.</source>
            <translation type="unfinished">À ne pas utiliser : une longueur mesurée le contredit.</translation>
        </message>
        <message>
            <source>computing: {what}</source>
            <translation type="unfinished">calcul : {what}</translation>
        </message>
        <message>
            <source>Cancelled; nothing was kept.</source>
            <translation type="unfinished">Annulé ; rien n’a été conservé.</translation>
        </message>
        <message>
            <source> mm</source>
            <translation type="unfinished"> mm</translation>
        </message>
        <message>
            <source>not measured</source>
            <translation type="unfinished">non mesurée</translation>
        </message>
        <message>
            <source>Distance of the lenses by ruler</source>
            <translation type="unfinished">Distance des objectifs à la règle</translation>
        </message>
        <message>
            <source>Import a calibration</source>
            <translation type="unfinished">Importer un étalonnage</translation>
        </message>
        <message>
            <source>Files…</source>
            <translation type="unfinished">Fichiers…</translation>
        </message>
        <message>
            <source>Folder…</source>
            <translation type="unfinished">Dossier…</translation>
        </message>
        <message>
            <source>Import and use it</source>
            <translation type="unfinished">Importer et utiliser</translation>
        </message>
        <message>
            <source>nothing is chosen yet</source>
            <translation type="unfinished">rien n’est encore choisi</translation>
        </message>
        <message>
            <source>reading …</source>
            <translation type="unfinished">lecture …</translation>
        </message>
        <message>
            <source>Calibration files, left before right</source>
            <translation type="unfinished">Fichiers d’étalonnage, gauche avant droite</translation>
        </message>
        <message>
            <source>Calibrations (*.yaml *.yml *.xml);;All files (*)</source>
            <translation type="unfinished">Étalonnages (*.yaml *.yml *.xml);;Tous les fichiers (*)</translation>
        </message>
        <message>
            <source>Folder of TemugeB's text files</source>
            <translation type="unfinished">Dossier des fichiers texte de TemugeB</translation>
        </message>
        <message>
            <source>Unit of the board's square (--unit)</source>
            <translation type="unfinished">Unité du carré de la mire (--unit)</translation>
        </message>
        <message>
            <source>Size of the pictures (--size)</source>
            <translation type="unfinished">Taille des images (--size)</translation>
        </message>
        <message>
            <source>One YAML of Acus; left and right YAML of ICube or ROS; the folder of TemugeB's text files; or intrinsics.yml and extrinsics.yml of OpenCV's stereo_calib. Only TemugeB's and OpenCV's files need unit and size. What other programs write does not say how sure it is, and has no place: find it on the page before.</source>
            <translation type="unfinished">Un YAML d’Acus ; les YAML gauche et droit d’ICube ou de ROS ; le dossier des fichiers texte de TemugeB ; ou intrinsics.yml et extrinsics.yml de stereo_calib (OpenCV). Seuls les fichiers de TemugeB et d’OpenCV demandent unité et taille. Ce qu’écrivent d’autres programmes ne dit pas sa propre certitude et n’a pas de position : trouvez-la à la page précédente.</translation>
        </message>
        <message>
            <source>✔ in use</source>
            <translation type="unfinished">✔ utilisé</translation>
        </message>
        <message>
            <source>✖ unreadable: {why}</source>
            <translation type="unfinished">✖ illisible : {why}</translation>
        </message>
        <message>
            <source>✖ found bad: {why}</source>
            <translation type="unfinished">✖ jugé mauvais : {why}</translation>
        </message>
        <message>
            <source>{px:.2f} px</source>
            <translation type="unfinished">{px:.2f} px</translation>
        </message>
        <message>
            <source>, {mm:.3f} mm held back</source>
            <translation type="unfinished">, {mm:.3f} mm sur les paires réservées</translation>
        </message>
        <message>
            <source>, own uncertainty not known</source>
            <translation type="unfinished">, incertitude propre inconnue</translation>
        </message>
        <message>
            <source>placed</source>
            <translation type="unfinished">placé</translation>
        </message>
        <message>
            <source>no place</source>
            <translation type="unfinished">sans position</translation>
        </message>
        <message>
            <source>Save and use it</source>
            <translation type="unfinished">Enregistrer et utiliser</translation>
        </message>
        <message>
            <source>Import…</source>
            <translation type="unfinished">Importer…</translation>
        </message>
        <message>
            <source>Use this one</source>
            <translation type="unfinished">Utiliser celui-ci</translation>
        </message>
        <message>
            <source>Found bad…</source>
            <translation type="unfinished">Jugé mauvais…</translation>
        </message>
        <message>
            <source>Calibration</source>
            <translation type="unfinished">Étalonnage</translation>
        </message>
        <message>
            <source>State</source>
            <translation type="unfinished">État</translation>
        </message>
        <message>
            <source>Save</source>
            <translation type="unfinished">Enregistrer</translation>
        </message>
        <message>
            <source>saved as {id} and in use</source>
            <translation type="unfinished">enregistré sous {id} et utilisé</translation>
        </message>
        <message>
            <source>There is nothing new to save.</source>
            <translation type="unfinished">Il n’y a rien de nouveau à enregistrer.</translation>
        </message>
        <message>
            <source>Not saved yet. Without a place (the page before) it cannot be used to track.</source>
            <translation type="unfinished">Pas encore enregistré. Sans position (la page précédente), il ne peut pas servir au suivi.</translation>
        </message>
        <message>
            <source>Not saved yet.</source>
            <translation type="unfinished">Pas encore enregistré.</translation>
        </message>
        <message>
            <source>; it has no place yet: find it on the page before</source>
            <translation type="unfinished">; il n’a pas encore de position : trouvez-la à la page précédente</translation>
        </message>
        <message>
            <source>imported as {id} and in use{note}</source>
            <translation type="unfinished">importé sous {id} et utilisé{note}</translation>
        </message>
        <message>
            <source>Found bad</source>
            <translation type="unfinished">Jugé mauvais</translation>
        </message>
        <message>
            <source>What is wrong with it? Attempts made with it will say so.</source>
            <translation type="unfinished">Qu’est-ce qui ne va pas ? Les essais faits avec lui le diront.</translation>
        </message>
        <message>
            <source>Calibrations so far; none is ever deleted. One that proves bad is no longer used, and attempts made with it are flagged.</source>
            <translation type="unfinished">Étalonnages à ce jour ; aucun n’est jamais supprimé. Celui qui se révèle mauvais n’est plus utilisé, et les essais faits avec lui sont signalés.</translation>
        </message>
        <message>
            <source>{pairs} pairs taken: both cameras see the board in each</source>
            <translation type="unfinished">Paires prises : {pairs} ; dans chacune, les deux caméras voient la mire</translation>
        </message>
        <message>
            <source>no pair in which both cameras see the board</source>
            <translation type="unfinished">aucune paire où les deux caméras voient la mire</translation>
        </message>
        <message>
            <source>{pairs} pairs, all of which are used; {different} of them show the board unlike the others: only those count below</source>
            <translation type="unfinished">Paires : {pairs}, toutes utilisées ; {different} montrent la mire autrement que les autres : seules celles-ci comptent ci-dessous</translation>
        </message>
        <message>
            <source>not used: {names}</source>
            <translation type="unfinished">non utilisées : {names}</translation>
        </message>
        <message>
            <source>Not good enough to use: glue the board on something flat, take sharper pictures, and check the board's counts and sizes.</source>
            <translation type="unfinished">Pas assez bon pour servir : collez la mire sur un support plan, prenez des images plus nettes, et vérifiez les nombres et les tailles de la mire.</translation>
        </message>
        <message>
            <source>It fits, but was not checked: there were too few pairs to hold some back. Take at least eight.</source>
            <translation type="unfinished">L’ajustement est bon mais n’a pas été vérifié : trop peu de paires pour en réserver. Prenez-en au moins huit.</translation>
        </message>
        <message>
            <source>Usable, but the pairs do not belong together: the board or a camera moved between the two pictures. What is stated is wider for it; hold the board still and take them again.</source>
            <translation type="unfinished">Utilisable, mais les images des paires ne concordent pas : la mire ou une caméra a bougé entre les deux. Les valeurs indiquées sont élargies d’autant ; tenez la mire immobile et reprenez-les.</translation>
        </message>
        <message>
            <source>Usable, but the board moved while its pictures were read row by row (rolling shutter): distances come out wrong. Hold the board against something still and take them again.</source>
            <translation type="unfinished">Utilisable, mais la mire bougeait pendant la lecture ligne par ligne des images (obturateur déroulant) : les distances sont faussées. Appuyez la mire contre un support fixe et reprenez-les.</translation>
        </message>
        <message>
            <source>Usable, but only where the board was seen: elsewhere in the pictures the rays are hardly known. Take more pairs with the board near the edges and corners.</source>
            <translation type="unfinished">Utilisable, mais seulement là où la mire a été vue : ailleurs dans les images, les rayons sont à peine connus. Prenez plus de paires avec la mire près des bords et des coins.</translation>
        </message>
        <message>
            <source>Usable, but worse than usual: more and sharper views will do better.</source>
            <translation type="unfinished">Utilisable, mais moins bon que d’habitude : des vues plus nombreuses et plus nettes feront mieux.</translation>
        </message>
        <message>
            <source>Good: pairs that took no part come out right.</source>
            <translation type="unfinished">Bon : les paires qui n’ont pas servi donnent un résultat juste.</translation>
        </message>
        <message>
            <source>The board's size is not checked: nothing else here can tell.</source>
            <translation type="unfinished">La taille de la mire n’est pas vérifiée : rien d’autre ici ne peut la dire.</translation>
        </message>
        <message>
            <source>Residual</source>
            <translation type="unfinished">Résidu</translation>
        </message>
        <message>
            <source>{pair:.2f} px both, {left:.2f} px {l}, {right:.2f} px {r}</source>
            <translation type="unfinished">{pair:.2f} px ensemble, {left:.2f} px {l}, {right:.2f} px {r}</translation>
        </message>
        <message>
            <source>Distance of the cameras</source>
            <translation type="unfinished">Distance des caméras</translation>
        </message>
        <message>
            <source>{mm:.2f} ± {sd:.2f} mm</source>
            <translation type="unfinished">{mm:.2f} ± {sd:.2f} mm</translation>
        </message>
        <message>
            <source>{n} pairs, {points} corners: {rms:.3f} mm RMS, {most:.3f} mm at most</source>
            <translation type="unfinished">Paires : {n}, coins : {points} ; {rms:.3f} mm RMS, {most:.3f} mm au plus</translation>
        </message>
        <message>
            <source>Pairs held back</source>
            <translation type="unfinished">Paires réservées</translation>
        </message>
        <message>
            <source>Lengths in them</source>
            <translation type="unfinished">Longueurs dedans</translation>
        </message>
        <message>
            <source>{scale:.5f} ± {sd:.5f} times the true ones</source>
            <translation type="unfinished">{scale:.5f} ± {sd:.5f} fois les vraies</translation>
        </message>
        <message>
            <source>(dropped)</source>
            <translation type="unfinished">(écarté)</translation>
        </message>
        <message>
            <source>In brackets: the views do not tell it; 0 is used.</source>
            <translation type="unfinished">Entre parenthèses : les vues ne le disent pas ; 0 est utilisé.</translation>
        </message>
        <message>
            <source>outlier, left out</source>
            <translation type="unfinished">aberrante, écartée</translation>
        </message>
        <message>
            <source>held back</source>
            <translation type="unfinished">réservée</translation>
        </message>
        <message>
            <source>{camera} camera at x {x:.0f}, y {y:.0f}, z {z:.0f} mm</source>
            <translation type="unfinished">caméra {camera} à x {x:.0f}, y {y:.0f}, z {z:.0f} mm</translation>
        </message>
        <message>
            <source>corners within {px:.2f} px</source>
            <translation type="unfinished">coins à {px:.2f} px près</translation>
        </message>
        <message>
            <source>at the fulcrum the frame is sure to ± {mm:.2f} mm (standard deviation per axis)</source>
            <translation type="unfinished">au point de pivot, le repère est sûr à ± {mm:.2f} mm (écart type par axe)</translation>
        </message>
        <message>
            <source>places agree within {mm:.1f} mm</source>
            <translation type="unfinished">les positions concordent à {mm:.1f} mm près</translation>
        </message>
        <message>
            <source>Daily check</source>
            <translation type="unfinished">Vérification du jour</translation>
        </message>
        <message>
            <source>Touch now</source>
            <translation type="unfinished">Toucher maintenant</translation>
        </message>
        <message>
            <source>Bring the simulated tip there</source>
            <translation type="unfinished">Y amener la pointe simulée</translation>
        </message>
        <message>
            <source>Keep as today's check</source>
            <translation type="unfinished">Conserver comme vérification du jour</translation>
        </message>
        <message>
            <source>nothing runs yet</source>
            <translation type="unfinished">rien ne tourne encore</translation>
        </message>
        <message>
            <source>choose an exercise and a patient: robot and cameras start with them</source>
            <translation type="unfinished">choisissez un exercice et un patient : robot et caméras démarrent avec eux</translation>
        </message>
        <message>
            <source>Everything is well</source>
            <translation type="unfinished">Tout va bien</translation>
        </message>
        <message>
            <source>Usable, with remarks</source>
            <translation type="unfinished">Utilisable, avec remarques</translation>
        </message>
        <message>
            <source>Not ready</source>
            <translation type="unfinished">Pas prêt</translation>
        </message>
        <message>
            <source>Something is still to be done</source>
            <translation type="unfinished">Il reste quelque chose à faire</translation>
        </message>
        <message>
            <source>never checked</source>
            <translation type="unfinished">jamais vérifié</translation>
        </message>
        <message>
            <source>Known point</source>
            <translation type="unfinished">Point connu</translation>
        </message>
        <message>
            <source>Screen and needle</source>
            <translation type="unfinished">Écran et aiguille</translation>
        </message>
        <message>
            <source>check failed</source>
            <translation type="unfinished">vérification échouée</translation>
        </message>
        <message>
            <source>not checked</source>
            <translation type="unfinished">non vérifié</translation>
        </message>
        <message>
            <source>Nobody has checked how well the needle on the screen agrees with the real one. Menu Checks, Registration check: touch the fiducials of a plate.</source>
            <translation type="unfinished">Personne n’a vérifié si l’aiguille à l’écran concorde avec la vraie. Menu Vérifications, Vérification du recalage : touchez les repères d’une plaque.</translation>
        </message>
        <message>
            <source>agree within ± {mm:.1f} mm (95 %)</source>
            <translation type="unfinished">concordent à ± {mm:.1f} mm (95 %)</translation>
        </message>
        <message>
            <source>How far the needle on the screen may be from the real one at the target: what the registration check found, with the cameras' error. {checked}</source>
            <translation type="unfinished">De combien l’aiguille à l’écran peut s’écarter de la vraie à la cible : ce qu’a trouvé la vérification du recalage, avec l’erreur des caméras. {checked}</translation>
        </message>
        <message>
            <source>{size}; the calibration's own uncertainty is unknown</source>
            <translation type="unfinished">{size} ; l’incertitude propre de l’étalonnage est inconnue</translation>
        </message>
        <message>
            <source>The calibration was imported and does not say how sure it is: the radius leaves its error out. Calibrate with pictures of a board to know it.</source>
            <translation type="unfinished">L’étalonnage a été importé et ne dit pas s’il est sûr : le rayon ne tient pas compte de son erreur. Étalonnez avec des images d’une mire pour la connaître.</translation>
        </message>
        <message>
            <source>Daily check…</source>
            <translation type="unfinished">Vérification du jour…</translation>
        </message>
        <message>
            <source>Registration check…</source>
            <translation type="unfinished">Vérification du recalage…</translation>
        </message>
        <message>
            <source>Draw errors of target and tip</source>
            <translation type="unfinished">Dessiner les erreurs de cible et de pointe</translation>
        </message>
        <message>
            <source>Checked {when} with {plate}.</source>
            <translation type="unfinished">Vérifié le {when} avec {plate}.</translation>
        </message>
        <message>
            <source>A plan is needed first: place entry and target.</source>
            <translation type="unfinished">Il faut d’abord un plan : placez le point d’entrée et la cible.</translation>
        </message>
        <message>
            <source>By the measured place the needle enters {moved:.0f} mm from the planned entry: lay the phantom so that its entry is at the robot's fulcrum (at most {most:.0f} mm), then measure again</source>
            <translation type="unfinished">Selon la position mesurée, l’aiguille entre à {moved:.0f} mm du point d’entrée prévu : posez le fantôme pour que son point d’entrée soit au point de pivot du robot (à {most:.0f} mm au plus), puis mesurez de nouveau</translation>
        </message>
        <message>
            <source>The measured place is used; the entry moved by {mm:.1f} mm</source>
            <translation type="unfinished">La position mesurée est utilisée ; le point d’entrée a bougé de {mm:.1f} mm</translation>
        </message>
        <message>
            <source>Fiducial</source>
            <translation type="unfinished">Repère</translation>
        </message>
        <message>
            <source>Tip: x  y  z [mm]</source>
            <translation type="unfinished">Pointe : x  y  z [mm]</translation>
        </message>
        <message>
            <source>± 95 % [mm]</source>
            <translation type="unfinished">± 95 % [mm]</translation>
        </message>
        <message>
            <source>CT: L  P  S [mm]</source>
            <translation type="unfinished">CT : L  P  S [mm]</translation>
        </message>
        <message>
            <source>Residual [mm]</source>
            <translation type="unfinished">Résidu [mm]</translation>
        </message>
        <message>
            <source>Pick the bead at the crosshair</source>
            <translation type="unfinished">Choisir la bille au réticule</translation>
        </message>
        <message>
            <source>Forget</source>
            <translation type="unfinished">Oublier</translation>
        </message>
        <message>
            <source>Use the measured place</source>
            <translation type="unfinished">Utiliser la position mesurée</translation>
        </message>
        <message>
            <source>Registration check</source>
            <translation type="unfinished">Vérification du recalage</translation>
        </message>
        <message>
            <source>No CT is shown: open the CT of the scanned phantom.</source>
            <translation type="unfinished">Aucun CT n’est affiché : ouvrez le CT du fantôme scanné.</translation>
        </message>
        <message>
            <source>The check could not be written: {why}</source>
            <translation type="unfinished">La vérification n’a pas pu être écrite : {why}</translation>
        </message>
        <message>
            <source>Plate</source>
            <translation type="unfinished">Plaque</translation>
        </message>
        <message>
            <source>No cameras run: choose an exercise and a patient first.</source>
            <translation type="unfinished">Aucune caméra ne tourne : choisissez d’abord un exercice et un patient.</translation>
        </message>
        <message>
            <source>Depth [mm]</source>
            <translation type="unfinished">Profondeur [mm]</translation>
        </message>
        <message>
            <source>target {mm:.0f} mm</source>
            <translation type="unfinished">cible {mm:.0f} mm</translation>
        </message>
        <message>
            <source>depth</source>
            <translation type="unfinished">profondeur</translation>
        </message>
        <message>
            <source>Off the path [mm]</source>
            <translation type="unfinished">Écart latéral [mm]</translation>
        </message>
        <message>
            <source>off the path</source>
            <translation type="unfinished">écart latéral</translation>
        </message>
        <message>
            <source>Angle error [°]</source>
            <translation type="unfinished">Erreur d’angle [°]</translation>
        </message>
        <message>
            <source>angle</source>
            <translation type="unfinished">angle</translation>
        </message>
        <message>
            <source>Force felt, {origin} [N]</source>
            <translation type="unfinished">Force ressentie, {origin} [N]</translation>
        </message>
        <message>
            <source>limit {n:g} N</source>
            <translation type="unfinished">limite {n:g} N</translation>
        </message>
        <message>
            <source>{origin} force</source>
            <translation type="unfinished">force, {origin}</translation>
        </message>
        <message>
            <source>Time [s]</source>
            <translation type="unfinished">Temps [s]</translation>
        </message>
        <message>
            <source>Point to read, click to go there; the wheel zooms, a double click shows all.</source>
            <translation type="unfinished">Pointez pour lire, cliquez pour y aller ; la molette zoome, un double clic montre tout.</translation>
        </message>
        <message>
            <source>ideal</source>
            <translation type="unfinished">idéal</translation>
        </message>
        <message>
            <source>Reading the other attempt</source>
            <translation type="unfinished">Lecture de l’autre essai</translation>
        </message>
        <message>
            <source>Save report</source>
            <translation type="unfinished">Enregistrer le rapport</translation>
        </message>
        <message>
            <source>not verified: the record is {verdict}</source>
            <translation type="unfinished">non vérifié : l’enregistrement est {verdict}</translation>
        </message>
        <message>
            <source>Export attempt</source>
            <translation type="unfinished">Exporter l’essai</translation>
        </message>
        <message>
            <source>CSV (*.csv)</source>
            <translation type="unfinished">CSV (*.csv)</translation>
        </message>
        <message>
            <source>Export sessions</source>
            <translation type="unfinished">Exporter les séances</translation>
        </message>
        <message>
            <source>Reading the attempt</source>
            <translation type="unfinished">Lecture de l’essai</translation>
        </message>
        <message>
            <source>This attempt is another one's: sign in as who made it, or as the instructor.</source>
            <translation type="unfinished">Cet essai est celui d’une autre personne : connectez-vous comme son auteur, ou comme formateur.</translation>
        </message>
        <message>
            <source>This attempt is an assessment (course: {course}). The instructor releases its result; until then neither score nor replay is shown here.</source>
            <translation type="unfinished">Cet essai est une évaluation (cours : {course}). Le formateur en publie le résultat ; d’ici là, ni note ni relecture ne s’affichent ici.</translation>
        </message>
        <message>
            <source>Cannot write {file}: {why}</source>
            <translation type="unfinished">Impossible d’écrire {file} : {why}</translation>
        </message>
        <message>
            <source>the expert, along your plan</source>
            <translation type="unfinished">l’expert, selon votre plan</translation>
        </message>
        <message>
            <source>the ideal path</source>
            <translation type="unfinished">la trajectoire idéale</translation>
        </message>
        <message>
            <source>{who}: {total} ({date})</source>
            <translation type="unfinished">{who} : {total} ({date})</translation>
        </message>
        <message>
            <source>own best: {total} ({date})</source>
            <translation type="unfinished">mon meilleur : {total} ({date})</translation>
        </message>
        <message>
            <source>own: {total} ({date})</source>
            <translation type="unfinished">le mien : {total} ({date})</translation>
        </message>
        <message>
            <source>ghost</source>
            <translation type="unfinished">comparaison</translation>
        </message>
        <message>
            <source>ghost, {total:.0f} points</source>
            <translation type="unfinished">comparaison, points : {total:.0f}</translation>
        </message>
        <message>
            <source>The CT of this attempt is not open: no slices, no 3D.</source>
            <translation type="unfinished">Le CT de cet essai n’est pas ouvert : pas de coupes, pas de 3D.</translation>
        </message>
        <message>
            <source>Looking whether the open CT is that of the attempt…</source>
            <translation type="unfinished">Vérifie si le CT ouvert est celui de l’essai…</translation>
        </message>
        <message>
            <source>Looking at the CT of the attempt</source>
            <translation type="unfinished">Examen du CT de l’essai</translation>
        </message>
        <message>
            <source>The CT that is open is not the one of this attempt: no slices, no 3D.</source>
            <translation type="unfinished">Le CT ouvert n’est pas celui de cet essai : pas de coupes, pas de 3D.</translation>
        </message>
        <message>
            <source>The slices are made of the CT that was scanned, {ct}: open it first</source>
            <translation type="unfinished">Les coupes viennent du CT scanné, {ct} : ouvrez-le d’abord</translation>
        </message>
        <message>
            <source>which is not open</source>
            <translation type="unfinished">qui n’est pas ouvert</translation>
        </message>
        <message>
            <source>Making the slices again</source>
            <translation type="unfinished">Nouveau calcul des coupes</translation>
        </message>
        <message>
            <source>a student</source>
            <translation type="unfinished">un étudiant</translation>
        </message>
        <message>
            <source>and {n} more</source>
            <translation type="unfinished">et {n} de plus</translation>
        </message>
        <message>
            <source>The program ended in the middle of an attempt:</source>
            <translation type="unfinished">Le programme s’est arrêté au milieu d’un essai :</translation>
        </message>
        <message>
            <source>The program ended in the middle of {n} attempts:</source>
            <translation type="unfinished">Le programme s’est arrêté au milieu de {n} essais :</translation>
        </message>
        <message>
            <source>Recover keeps what was recorded: it stays in the list as unfinished, without a score. Later changes nothing; the list of sessions offers it too.</source>
            <translation type="unfinished">Récupérer garde ce qui a été enregistré : cela reste dans la liste comme inachevé, sans note. Plus tard ne change rien ; la liste des séances le propose aussi.</translation>
        </message>
        <message>
            <source>Interrupted attempts</source>
            <translation type="unfinished">Essais interrompus</translation>
        </message>
        <message>
            <source>Recover</source>
            <translation type="unfinished">Récupérer</translation>
        </message>
        <message>
            <source>Discard</source>
            <translation type="unfinished">Rejeter</translation>
        </message>
        <message>
            <source>To the deleted ones; the instructor can bring it back</source>
            <translation type="unfinished">Vers les supprimés ; le formateur peut le rétablir</translation>
        </message>
        <message>
            <source>Later</source>
            <translation type="unfinished">Plus tard</translation>
        </message>
        <message>
            <source>Saved {name}</source>
            <translation type="unfinished">Enregistré : {name}</translation>
        </message>
        <message>
            <source>Past sessions</source>
            <translation type="unfinished">Séances passées</translation>
        </message>
        <message>
            <source>Show this attempt as the demonstration</source>
            <translation type="unfinished">Montrer cet essai comme démonstration</translation>
        </message>
        <message>
            <source>Let the scripted expert show it again</source>
            <translation type="unfinished">Laisser de nouveau l’expert automatique montrer</translation>
        </message>
        <message>
            <source>This exercise is no more what it was: begin it from the start page.</source>
            <translation type="unfinished">Cet exercice n’est plus ce qu’il était : commencez-le depuis la page d’accueil.</translation>
        </message>
        <message>
            <source>Show me now shows this attempt in {title}: its movement, without a name or score.</source>
            <translation type="unfinished">« Montrez-moi » montre désormais cet essai dans {title} : son mouvement, sans nom ni note.</translation>
        </message>
        <message>
            <source>Show me shows the scripted expert in {title}.</source>
            <translation type="unfinished">« Montrez-moi » montre l’expert automatique dans {title}.</translation>
        </message>
        <message>
            <source>Bring earlier attempts here…</source>
            <translation type="unfinished">Amener ici les essais antérieurs…</translation>
        </message>
        <message>
            <source>Attempts of this station lie in {there}, where earlier versions kept them: {n}. Bring them to {here}? They are then no more in the other folder.</source>
            <translation type="unfinished">Des essais de ce poste sont dans {there}, où les versions antérieures les gardaient : {n}. Les amener dans {here} ? Ils ne seront plus dans l’autre dossier.</translation>
        </message>
        <message>
            <source>Earlier attempts</source>
            <translation type="unfinished">Essais antérieurs</translation>
        </message>
        <message>
            <source>Earlier attempts lie in {there} ({n}): Sessions ▸ Bring earlier attempts here…</source>
            <translation type="unfinished">Des essais antérieurs sont dans {there} ({n}) : Séances ▸ Amener ici les essais antérieurs…</translation>
        </message>
        <message>
            <source>1 attempt has come; it is in the list (F7).</source>
            <translation type="unfinished">1 essai est arrivé ; il est dans la liste (F7).</translation>
        </message>
        <message>
            <source>{n} attempts have come; they are in the list (F7).</source>
            <translation type="unfinished">{n} essais sont arrivés ; ils sont dans la liste (F7).</translation>
        </message>
        <message>
            <source>vessel</source>
            <translation type="unfinished">vaisseau</translation>
        </message>
        <message>
            <source>lung</source>
            <translation type="unfinished">poumon</translation>
        </message>
        <message>
            <source>gut</source>
            <translation type="unfinished">intestin</translation>
        </message>
        <message>
            <source>heart</source>
            <translation type="unfinished">cœur</translation>
        </message>
        <message>
            <source>organ</source>
            <translation type="unfinished">organe</translation>
        </message>
        <message>
            <source>✖ This fails the attempt.</source>
            <translation type="unfinished">✖ Ceci fait échouer l’essai.</translation>
        </message>
        <message>
            <source>{met}, at {when}</source>
            <translation type="unfinished">{met}, à {when}</translation>
        </message>
        <message>
            <source>met {n} times here</source>
            <translation type="unfinished">rencontré {n} fois ici</translation>
        </message>
        <message>
            <source>longest way in it: {mm:.1f} mm</source>
            <translation type="unfinished">plus long trajet dedans : {mm:.1f} mm</translation>
        </message>
        <message>
            <source>largest force along the needle: {force:.1f} N</source>
            <translation type="unfinished">force maximale le long de l’aiguille : {force:.1f} N</translation>
        </message>
        <message>
            <source>force along the needle: nobody felt it</source>
            <translation type="unfinished">force le long de l’aiguille : personne ne l’a ressentie</translation>
        </message>
        <message>
            <source>{angle:.0f}° from straight in</source>
            <translation type="unfinished">à {angle:.0f}° de la perpendiculaire</translation>
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
            <translation type="unfinished">Coupes</translation>
        </message>
        <message>
            <source>Shows</source>
            <translation type="unfinished">Montre</translation>
        </message>
        <message>
            <source>Enter or a double click shows its slices, if the CT is open</source>
            <translation type="unfinished">Entrée ou un double clic montre ses coupes, si le CT est ouvert</translation>
        </message>
        <message>
            <source>{n} × {mm:g} mm, {low} to {high}</source>
            <translation type="unfinished">{n} × {mm:g} mm, {low} à {high}</translation>
        </message>
        <message>
            <source>● tip</source>
            <translation type="unfinished">● pointe</translation>
        </message>
        <message>
            <source>▲ shaft only</source>
            <translation type="unfinished">▲ tige seule</translation>
        </message>
        <message>
            <source>✖ no needle</source>
            <translation type="unfinished">✖ pas d’aiguille</translation>
        </message>
        <message>
            <source>Metric</source>
            <translation type="unfinished">Indicateur</translation>
        </message>
        <message>
            <source>Value</source>
            <translation type="unfinished">Valeur</translation>
        </message>
        <message>
            <source>Band</source>
            <translation type="unfinished">Palier</translation>
        </message>
        <message>
            <source>Points</source>
            <translation type="unfinished">Points</translation>
        </message>
        <message>
            <source>Weight</source>
            <translation type="unfinished">Poids</translation>
        </message>
        <message>
            <source>Save report (PDF)</source>
            <translation type="unfinished">Enregistrer le rapport (PDF)</translation>
        </message>
        <message>
            <source>Export CSV</source>
            <translation type="unfinished">Exporter en CSV</translation>
        </message>
        <message>
            <source>Again</source>
            <translation type="unfinished">Refaire</translation>
        </message>
        <message>
            <source>Sessions</source>
            <translation type="unfinished">Séances</translation>
        </message>
        <message>
            <source>Closest to structures of risk</source>
            <translation type="unfinished">Au plus près des structures à risque</translation>
        </message>
        <message>
            <source>What the needle met, with the force along the needle</source>
            <translation type="unfinished">Ce que l’aiguille a rencontré, avec la force le long de l’aiguille</translation>
        </message>
        <message>
            <source>Next: {title}</source>
            <translation type="unfinished">Suite : {title}</translation>
        </message>
        <message>
            <source>All metrics</source>
            <translation type="unfinished">Tous les indicateurs</translation>
        </message>
        <message>
            <source>Every metric with its value, band and points; remembered</source>
            <translation type="unfinished">Chaque indicateur avec sa valeur, son palier et ses points ; choix mémorisé</translation>
        </message>
        <message>
            <source>Drill, {drill}: {title}</source>
            <translation type="unfinished">Exercice ciblé, {drill} : {title}</translation>
        </message>
        <message>
            <source>control scans: {n}</source>
            <translation type="unfinished">scans de contrôle : {n}</translation>
        </message>
        <message>
            <source>Track of the tip, seen along the planned path; a square where it began, a diamond where it ended; the arrow is the force at the hand</source>
            <translation type="unfinished">Tracé de la pointe, vu le long de la trajectoire planifiée ; un carré au début, un losange à la fin ; la flèche est la force à la main</translation>
        </message>
        <message>
            <source>{force:.1f} N</source>
            <translation type="unfinished">{force:.1f} N</translation>
        </message>
        <message>
            <source>Rates of published series of patients, with their sources: not the probability for this patient, and no part of the score</source>
            <translation type="unfinished">Taux de séries de patients publiées, avec leurs sources : ni la probabilité pour ce patient, ni une part de la note</translation>
        </message>
        <message>
            <source>Published risks of what was met</source>
            <translation type="unfinished">Risques publiés de ce qui a été rencontré</translation>
        </message>
        <message>
            <source>Declared void by the instructor: {why}</source>
            <translation type="unfinished">Déclaré nul par le formateur : {why}</translation>
        </message>
        <message>
            <source>The instructor says: {words}</source>
            <translation type="unfinished">Le formateur dit : {words}</translation>
        </message>
        <message>
            <source>Not released: the student sees no result yet (course {name})</source>
            <translation type="unfinished">Non publié : l’étudiant ne voit pas encore de résultat (cours {name})</translation>
        </message>
        <message>
            <source>Instructor</source>
            <translation type="unfinished">Formateur</translation>
        </message>
        <message>
            <source>Comment on the selected attempts, declare them void, release their results</source>
            <translation type="unfinished">Commenter les essais choisis, les déclarer nuls, publier leurs résultats</translation>
        </message>
        <message>
            <source>Comment…</source>
            <translation type="unfinished">Commenter…</translation>
        </message>
        <message>
            <source>Say something that the student reads in the debrief</source>
            <translation type="unfinished">Dire quelque chose que l’étudiant lit au débriefing</translation>
        </message>
        <message>
            <source>Declare void…</source>
            <translation type="unfinished">Déclarer nul…</translation>
        </message>
        <message>
            <source>It stays in the list but does not count; the student can read the reason</source>
            <translation type="unfinished">Il reste dans la liste mais ne compte pas ; l’étudiant peut lire la raison</translation>
        </message>
        <message>
            <source>Let it count again</source>
            <translation type="unfinished">Le faire compter de nouveau</translation>
        </message>
        <message>
            <source>Take back that it was declared void</source>
            <translation type="unfinished">Annule sa déclaration de nullité</translation>
        </message>
        <message>
            <source>Release the result</source>
            <translation type="unfinished">Publier le résultat</translation>
        </message>
        <message>
            <source>Let the student see score and replay</source>
            <translation type="unfinished">Laisser l’étudiant voir la note et la relecture</translation>
        </message>
        <message>
            <source>Hold the result back</source>
            <translation type="unfinished">Retenir le résultat</translation>
        </message>
        <message>
            <source>Hide it again until it is released</source>
            <translation type="unfinished">Le masquer de nouveau jusqu’à sa publication</translation>
        </message>
        <message>
            <source>Admit…</source>
            <translation type="unfinished">Admettre…</translation>
        </message>
        <message>
            <source>Let an attempt count that this station has not signed; the reason is sealed</source>
            <translation type="unfinished">Faire compter un essai que ce poste n’a pas signé ; la raison est scellée</translation>
        </message>
        <message>
            <source>It counts again</source>
            <translation type="unfinished">Compte de nouveau</translation>
        </message>
        <message>
            <source>Released</source>
            <translation type="unfinished">Publié</translation>
        </message>
        <message>
            <source>Held back</source>
            <translation type="unfinished">Retenu</translation>
        </message>
        <message>
            <source>The student reads this in the debrief and in the list. Empty: none.</source>
            <translation type="unfinished">L’étudiant lit ceci au débriefing et dans la liste. Vide : aucun.</translation>
        </message>
        <message>
            <source>Comment</source>
            <translation type="unfinished">Commentaire</translation>
        </message>
        <message>
            <source>It will not count: not on the board, in any curve or for any course. The record stays, and this can be undone. Why? The student can read the reason.</source>
            <translation type="unfinished">Il ne comptera pas : ni au tableau, ni dans une courbe, ni pour un cours. L’enregistrement reste, et ceci peut être annulé. Pourquoi ? L’étudiant peut lire la raison.</translation>
        </message>
        <message>
            <source>Declare void</source>
            <translation type="unfinished">Déclarer nul</translation>
        </message>
        <message>
            <source>This station did not sign it: it counts on no board and for no course. Why is it to count all the same? The reason is sealed with the record as it is now.</source>
            <translation type="unfinished">Ce poste ne l’a pas signé : il ne compte à aucun tableau ni pour aucun cours. Pourquoi doit-il compter quand même ? La raison est scellée avec l’enregistrement tel qu’il est maintenant.</translation>
        </message>
        <message>
            <source>Admit</source>
            <translation type="unfinished">Admettre</translation>
        </message>
        <message>
            <source>Comment kept</source>
            <translation type="unfinished">Commentaire conservé</translation>
        </message>
        <message>
            <source>Comment removed</source>
            <translation type="unfinished">Commentaire supprimé</translation>
        </message>
        <message>
            <source>Say why: the student reads it in the list and in the debrief.</source>
            <translation type="unfinished">Dites pourquoi : l’étudiant le lit dans la liste et au débriefing.</translation>
        </message>
        <message>
            <source>{n} attempts declared void</source>
            <translation type="unfinished">{n} essais déclarés nuls</translation>
        </message>
        <message>
            <source>1 attempt declared void</source>
            <translation type="unfinished">1 essai déclaré nul</translation>
        </message>
        <message>
            <source>Only the instructor does that: Sessions ▸ Sign in.</source>
            <translation type="unfinished">Seul le formateur peut le faire : Séances ▸ Se connecter.</translation>
        </message>
        <message>
            <source>{n} attempts admitted</source>
            <translation type="unfinished">{n} essais admis</translation>
        </message>
        <message>
            <source>1 attempt admitted</source>
            <translation type="unfinished">1 essai admis</translation>
        </message>
        <message>
            <source>{done}: {n} attempts</source>
            <translation type="unfinished">{done} : {n} essais</translation>
        </message>
        <message>
            <source>{done}: 1 attempt</source>
            <translation type="unfinished">{done} : 1 essai</translation>
        </message>
        <message>
            <source>Place in the attempt</source>
            <translation type="unfinished">Position dans l’essai</translation>
        </message>
        <message>
            <source>nothing</source>
            <translation type="unfinished">rien</translation>
        </message>
        <message>
            <source>How fast it is played</source>
            <translation type="unfinished">Vitesse de lecture</translation>
        </message>
        <message>
            <source>along the needle</source>
            <translation type="unfinished">le long de l’aiguille</translation>
        </message>
        <message>
            <source>along the planned path</source>
            <translation type="unfinished">le long de la trajectoire planifiée</translation>
        </message>
        <message>
            <source>Where the two slices lie</source>
            <translation type="unfinished">Où se trouvent les deux coupes</translation>
        </message>
        <message>
            <source>at the same time</source>
            <translation type="unfinished">au même moment</translation>
        </message>
        <message>
            <source>at the same depth</source>
            <translation type="unfinished">à la même profondeur</translation>
        </message>
        <message>
            <source>What is shown beside the needle: dotted in slices and curves, dashed in 3D</source>
            <translation type="unfinished">Ce qui s’affiche à côté de l’aiguille : en pointillés dans coupes et courbes, en tirets en 3D</translation>
        </message>
        <message>
            <source>By what the two attempts are brought together</source>
            <translation type="unfinished">Ce qui met les deux essais en correspondance</translation>
        </message>
        <message>
            <source>Space plays and pauses; the arrows go on and back, with Shift farther; Home, End</source>
            <translation type="unfinished">Espace lance et arrête ; les flèches avancent et reculent, avec Maj plus loin ; Début, Fin</translation>
        </message>
        <message>
            <source>Speed</source>
            <translation type="unfinished">Vitesse</translation>
        </message>
        <message>
            <source>Beside it</source>
            <translation type="unfinished">À côté</translation>
        </message>
        <message>
            <source>Aligned</source>
            <translation type="unfinished">Aligné</translation>
        </message>
        <message>
            <source>❚❚ Pause</source>
            <translation type="unfinished">❚❚ Pause</translation>
        </message>
        <message>
            <source>▶ Play</source>
            <translation type="unfinished">▶ Lecture</translation>
        </message>
        <message>
            <source>Open its CT…</source>
            <translation type="unfinished">Ouvrir son CT…</translation>
        </message>
        <message>
            <source>{mm:g} mm</source>
            <translation type="unfinished">{mm:g} mm</translation>
        </message>
        <message>
            <source>Acus attempt {id}</source>
            <translation type="unfinished">Essai Acus {id}</translation>
        </message>
        <message>
            <source>Report of an attempt</source>
            <translation type="unfinished">Rapport d’un essai</translation>
        </message>
        <message>
            <source>Watched by (pseudonym)</source>
            <translation type="unfinished">Regardé par (pseudonyme)</translation>
        </message>
        <message>
            <source>Student (pseudonym)</source>
            <translation type="unfinished">Étudiant (pseudonyme)</translation>
        </message>
        <message>
            <source>Date</source>
            <translation type="unfinished">Date</translation>
        </message>
        <message>
            <source>Session</source>
            <translation type="unfinished">Séance</translation>
        </message>
        <message>
            <source>Duration</source>
            <translation type="unfinished">Durée</translation>
        </message>
        <message>
            <source>Path</source>
            <translation type="unfinished">Trajectoire</translation>
        </message>
        <message>
            <source>{mm:.1f} mm from entry to target</source>
            <translation type="unfinished">{mm:.1f} mm du point d’entrée à la cible</translation>
        </message>
        <message>
            <source>Tip measured to</source>
            <translation type="unfinished">Pointe mesurée à</translation>
        </message>
        <message>
            <source>Recorded with</source>
            <translation type="unfinished">Enregistré avec</translation>
        </message>
        <message>
            <source>Made under</source>
            <translation type="unfinished">Conditions</translation>
        </message>
        <message>
            <source>{n}, {tips} of them with the tip; {dose:.1f} mGy·cm ({estimate})</source>
            <translation type="unfinished">{n}, dont {tips} avec la pointe ; {dose:.1f} mGy·cm ({estimate})</translation>
        </message>
        <message>
            <source>not recorded</source>
            <translation type="unfinished">non enregistré</translation>
        </message>
        <message>
            <source>± {mm:.1f} mm (95 %), median</source>
            <translation type="unfinished">± {mm:.1f} mm (95 %), médiane</translation>
        </message>
        <message>
            <source>* required to pass</source>
            <translation type="unfinished">* requis pour réussir</translation>
        </message>
        <message>
            <source>Course of the attempt</source>
            <translation type="unfinished">Déroulement de l’essai</translation>
        </message>
        <message>
            <source>Track of the tip, seen along the planned path</source>
            <translation type="unfinished">Tracé de la pointe, vu le long de la trajectoire planifiée</translation>
        </message>
        <message>
            <source>□ where it began   ◆ where it ended
Rings: {expert:g} mm expert, {passing:g} mm pass
Letters: directions of the patient
▼ control scan</source>
            <translation type="unfinished">□ début   ◆ fin
Anneaux : {expert:g} mm expert, {passing:g} mm réussi
Lettres : directions du patient
▼ scan de contrôle</translation>
        </message>
        <message>
            <source>page {page} of 2</source>
            <translation type="unfinished">page {page} sur 2</translation>
        </message>
        <message>
            <source>✖ {name}: needle inside, {depth:.1f} mm deep, at {when} (limit {limit:g} mm)</source>
            <translation type="unfinished">✖ {name} : aiguille dedans, à {depth:.1f} mm de profondeur, à {when} (limite {limit:g} mm)</translation>
        </message>
        <message>
            <source>▲ {name}: {distance:.1f} mm, at {when}: nearer than {limit:g} mm</source>
            <translation type="unfinished">▲ {name} : {distance:.1f} mm, à {when} : plus près que {limit:g} mm</translation>
        </message>
        <message>
            <source>✔ {name}: {distance:.1f} mm, at {when} (limit {limit:g} mm)</source>
            <translation type="unfinished">✔ {name} : {distance:.1f} mm, à {when} (limite {limit:g} mm)</translation>
        </message>
        <message>
            <source>real robot</source>
            <translation type="unfinished">vrai robot</translation>
        </message>
        <message>
            <source>emulated robot</source>
            <translation type="unfinished">robot émulé</translation>
        </message>
        <message>
            <source>simulated robot</source>
            <translation type="unfinished">robot simulé</translation>
        </message>
        <message>
            <source>pen and webcam</source>
            <translation type="unfinished">stylo et webcam</translation>
        </message>
        <message>
            <source>robot not known</source>
            <translation type="unfinished">robot inconnu</translation>
        </message>
        <message>
            <source>script ({skill})</source>
            <translation type="unfinished">script ({skill})</translation>
        </message>
        <message>
            <source>mouse</source>
            <translation type="unfinished">souris</translation>
        </message>
        <message>
            <source>keyboard</source>
            <translation type="unfinished">clavier</translation>
        </message>
        <message>
            <source>tablet</source>
            <translation type="unfinished">tablette</translation>
        </message>
        <message>
            <source>gamepad</source>
            <translation type="unfinished">manette</translation>
        </message>
        <message>
            <source>hand at the robot</source>
            <translation type="unfinished">main au robot</translation>
        </message>
        <message>
            <source>pen</source>
            <translation type="unfinished">stylo</translation>
        </message>
        <message>
            <source>script</source>
            <translation type="unfinished">script</translation>
        </message>
        <message>
            <source>the arm (simulation)</source>
            <translation type="unfinished">le bras (simulation)</translation>
        </message>
        <message>
            <source>{first}, then {later}</source>
            <translation type="unfinished">{first}, puis {later}</translation>
        </message>
        <message>
            <source>◇ Begun by the arm (simulation), then taken over by {hand}: not a student's attempt, it is not scored for anyone</source>
            <translation type="unfinished">◇ Commencé par le bras (simulation), puis repris ({hand}) : ce n’est pas l’essai d’un étudiant, il n’est noté pour personne</translation>
        </message>
        <message>
            <source>◇ Carried out by the arm (simulation), not by a student: it is not scored for anyone</source>
            <translation type="unfinished">◇ Exécuté par le bras (simulation), non par un étudiant : il n’est noté pour personne</translation>
        </message>
        <message>
            <source>◇ no student's</source>
            <translation type="unfinished">◇ pas d’un étudiant</translation>
        </message>
        <message>
            <source>assistance {dial}</source>
            <translation type="unfinished">assistance {dial}</translation>
        </message>
        <message>
            <source>▲ model changed meanwhile: {models}</source>
            <translation type="unfinished">▲ modèle changé entre-temps : {models}</translation>
        </message>
        <message>
            <source>Hand and robot</source>
            <translation type="unfinished">Main et robot</translation>
        </message>
        <message>
            <source>Computer</source>
            <translation type="unfinished">Ordinateur</translation>
        </message>
        <message>
            <source>Models changed meanwhile</source>
            <translation type="unfinished">Modèles changés entre-temps</translation>
        </message>
        <message>
            <source>Software</source>
            <translation type="unfinished">Logiciel</translation>
        </message>
        <message>
            <source>{start} as set, throughout</source>
            <translation type="unfinished">{start} comme réglé, du début à la fin</translation>
        </message>
        <message>
            <source>set {start}; least {least:z.2f}, most {most:z.2f}, over time {mean:z.2f}</source>
            <translation type="unfinished">réglé {start} ; minimum {least:z.2f}, maximum {most:z.2f}, moyenne {mean:z.2f}</translation>
        </message>
        <message>
            <source>simulated cameras</source>
            <translation type="unfinished">caméras simulées</translation>
        </message>
        <message>
            <source>calibration {id}</source>
            <translation type="unfinished">étalonnage {id}</translation>
        </message>
        <message>
            <source>no calibration</source>
            <translation type="unfinished">pas d’étalonnage</translation>
        </message>
        <message>
            <source>not checked; {calibration}</source>
            <translation type="unfinished">non vérifié ; {calibration}</translation>
        </message>
        <message>
            <source>agree within {mm:.1f} mm (95 %); {calibration}</source>
            <translation type="unfinished">concordent à {mm:.1f} mm (95 %) ; {calibration}</translation>
        </message>
        <message>
            <source>version {n}</source>
            <translation type="unfinished">version {n}</translation>
        </message>
        <message>
            <source>version not recorded</source>
            <translation type="unfinished">version non enregistrée</translation>
        </message>
        <message>
            <source>level {n}</source>
            <translation type="unfinished">niveau {n}</translation>
        </message>
        <message>
            <source>none</source>
            <translation type="unfinished">aucune</translation>
        </message>
        <message>
            <source>scoring version {n}</source>
            <translation type="unfinished">version de notation {n}</translation>
        </message>
        <message>
            <source>seed {n}</source>
            <translation type="unfinished">graine {n}</translation>
        </message>
        <message>
            <source>fail</source>
            <translation type="unfinished">échoué</translation>
        </message>
        <message>
            <source>Smoothness</source>
            <translation type="unfinished">Fluidité</translation>
        </message>
        <message>
            <source>Largest distance from the path</source>
            <translation type="unfinished">Plus grande distance à la trajectoire</translation>
        </message>
        <message>
            <source>Mean distance from the path</source>
            <translation type="unfinished">Distance moyenne à la trajectoire</translation>
        </message>
        <message>
            <source>Void: not judged.</source>
            <translation type="unfinished">Nul : non jugé.</translation>
        </message>
        <message>
            <source>to the left</source>
            <translation type="unfinished">vers la gauche</translation>
        </message>
        <message>
            <source>to the right</source>
            <translation type="unfinished">vers la droite</translation>
        </message>
        <message>
            <source>to the patient's left</source>
            <translation type="unfinished">vers la gauche du patient</translation>
        </message>
        <message>
            <source>to the patient's right</source>
            <translation type="unfinished">vers la droite du patient</translation>
        </message>
        <message>
            <source>towards the back</source>
            <translation type="unfinished">vers l’arrière</translation>
        </message>
        <message>
            <source>towards the front</source>
            <translation type="unfinished">vers l’avant</translation>
        </message>
        <message>
            <source>towards the head</source>
            <translation type="unfinished">vers la tête</translation>
        </message>
        <message>
            <source>towards the feet</source>
            <translation type="unfinished">vers les pieds</translation>
        </message>
        <message>
            <source>{side} and {other_side}</source>
            <translation type="unfinished">{side} et {other_side}</translation>
        </message>
        <message>
            <source>At {depth:.0f} mm depth you were {mm:.1f} mm off the line {where}.</source>
            <translation type="unfinished">À {depth:.0f} mm de profondeur, vous déviiez de la ligne de {mm:.1f} mm {where}.</translation>
        </message>
        <message>
            <source>From {depth:.0f} mm depth on you were off the line {where}, by up to {mm:.1f} mm.</source>
            <translation type="unfinished">À partir de {depth:.0f} mm de profondeur, vous déviiez de la ligne {where}, jusqu’à {mm:.1f} mm.</translation>
        </message>
        <message>
            <source>You left the line between {low:.0f} and {high:.0f} mm depth {where}, by up to {mm:.1f} mm.</source>
            <translation type="unfinished">Entre {low:.0f} et {high:.0f} mm de profondeur, vous avez quitté la ligne {where}, jusqu’à {mm:.1f} mm.</translation>
        </message>
        <message>
            <source>At the skin the needle was in line: {tilt:.1f}° off.</source>
            <translation type="unfinished">À la peau, l’aiguille était dans la ligne : écart de {tilt:.1f}°.</translation>
        </message>
        <message>
            <source>The tilt at the skin was {tilt:.1f}° off: the tip pointed too far {where}.</source>
            <translation type="unfinished">L’inclinaison à la peau était fausse de {tilt:.1f}° : la pointe était trop dirigée {where}.</translation>
        </message>
        <message>
            <source>The tip ended {mm:.1f} mm too deep.</source>
            <translation type="unfinished">À la fin, la pointe était {mm:.1f} mm trop profond.</translation>
        </message>
        <message>
            <source>The tip ended {mm:.1f} mm too deep: it passed the target's depth at {clock}.</source>
            <translation type="unfinished">À la fin, la pointe était {mm:.1f} mm trop profond : elle a dépassé la profondeur de la cible à {clock}.</translation>
        </message>
        <message>
            <source>The tip was {mm:.1f} mm too deep at {clock}, then drawn back to {short:.1f} mm short of the target.</source>
            <translation type="unfinished">La pointe était {mm:.1f} mm trop profond à {clock}, puis a été ramenée à {short:.1f} mm avant la cible.</translation>
        </message>
        <message>
            <source>The tip stopped {mm:.1f} mm short of the target; it came no deeper after {clock}.</source>
            <translation type="unfinished">La pointe s’est arrêtée {mm:.1f} mm avant la cible ; après {clock}, elle n’est pas allée plus profond.</translation>
        </message>
        <message>
            <source>You pushed {outside:.0f} of {whole:.0f} mm while the breath had moved the target by more than {gate:.1f} mm.</source>
            <translation type="unfinished">Vous avez avancé de {outside:.0f} mm sur {whole:.0f} alors que la respiration avait déplacé la cible de plus de {gate:.1f} mm.</translation>
        </message>
        <message>
            <source>{stage} took longest against its band: {seconds:.0f} s, of which {good:.0f} s are good.</source>
            <translation type="unfinished">Étape la plus longue par rapport à son palier : {stage}, {seconds:.0f} s ; {good:.0f} s, c’est bon.</translation>
        </message>
        <message>
            <source>{stage} took longest: {seconds:.0f} of {whole:.0f} s.</source>
            <translation type="unfinished">Étape la plus longue : {stage}, {seconds:.0f} s sur {whole:.0f}.</translation>
        </message>
        <message>
            <source>Holding still</source>
            <translation type="unfinished">Maintien immobile</translation>
        </message>
        <message>
            <source>The force was largest at {clock}: {newton:.1f} N.</source>
            <translation type="unfinished">La force était maximale à {clock} : {newton:.1f} N.</translation>
        </message>
        <message>
            <source>The force was largest at {depth:.0f} mm depth, at {clock}: {newton:.1f} N.</source>
            <translation type="unfinished">La force était maximale à {depth:.0f} mm de profondeur, à {clock} : {newton:.1f} N.</translation>
        </message>
        <message>
            <source>{met}, at {clock}.</source>
            <translation type="unfinished">{met}, à {clock}.</translation>
        </message>
        <message>
            <source>The needle was inside {name} at {clock}, with its tip at {depth:.0f} mm depth.</source>
            <translation type="unfinished">À {clock}, l’aiguille était dans « {name} », la pointe à {depth:.0f} mm de profondeur.</translation>
        </message>
        <message>
            <source>The needle came within {mm:.1f} mm of {name} at {clock}, with its tip at {depth:.0f} mm depth.</source>
            <translation type="unfinished">À {clock}, l’aiguille est passée à {mm:.1f} mm de « {name} », la pointe à {depth:.0f} mm de profondeur.</translation>
        </message>
        <message>
            <source>{outside} of {n} control scans were taken before the needle was in the skin.</source>
            <translation type="unfinished">Scans de contrôle pris avant que l’aiguille soit dans la peau : {outside} sur {n}.</translation>
        </message>
        <message>
            <source>{mm:.1f} mm {side}</source>
            <translation type="unfinished">{mm:.1f} mm {side}</translation>
        </message>
        <message>
            <source>at its depth</source>
            <translation type="unfinished">à sa profondeur</translation>
        </message>
        <message>
            <source>{mm:.1f} mm too deep</source>
            <translation type="unfinished">{mm:.1f} mm trop profond</translation>
        </message>
        <message>
            <source>{mm:.1f} mm short of it</source>
            <translation type="unfinished">{mm:.1f} mm trop court</translation>
        </message>
        <message>
            <source>The needle ended {mm:.1f} mm beside the target{where}, and {along}.</source>
            <translation type="unfinished">L’aiguille a fini à {mm:.1f} mm à côté de la cible{where}, {along}.</translation>
        </message>
        <message>
            <source>The target was missed: all else counts only {share:.0f} %.</source>
            <translation type="unfinished">La cible a été manquée : tout le reste ne compte que pour {share:.0f} %.</translation>
        </message>
        <message>
            <source>You turned the needle by {angle:.1f}° at {depth:.0f} mm depth.</source>
            <translation type="unfinished">Vous avez tourné l’aiguille de {angle:.1f}° à {depth:.0f} mm de profondeur.</translation>
        </message>
        <message>
            <source>The same turn at {earlier:.0f} mm takes {share:.0f} % of the side force.</source>
            <translation type="unfinished">Le même pivotement à {earlier:.0f} mm demande {share:.0f} % de la force latérale.</translation>
        </message>
        <message>
            <source>align only</source>
            <translation type="unfinished">alignement seul</translation>
        </message>
        <message>
            <source>depth only</source>
            <translation type="unfinished">profondeur seule</translation>
        </message>
        <message>
            <source>breath</source>
            <translation type="unfinished">respiration</translation>
        </message>
        <message>
            <source>ten times three minutes</source>
            <translation type="unfinished">dix fois trois minutes</translation>
        </message>
        <message>
            <source>Round {n} of {all} is done.</source>
            <translation type="unfinished">Tour {n} sur {all} terminé.</translation>
        </message>
        <message>
            <source>{drill} It counts for no course and no pass.</source>
            <translation type="unfinished">{drill} Cela ne compte pour aucun cours ni pour la réussite.</translation>
        </message>
        <message>
            <source>Practise: {drill}</source>
            <translation type="unfinished">S’exercer : {drill}</translation>
        </message>
        <message>
            <source>Nothing cost points.</source>
            <translation type="unfinished">Rien n’a coûté de points.</translation>
        </message>
        <message>
            <source>{label}: {value} cost {points}; {expert} or more costs none.</source>
            <translation type="unfinished">{label} : {value} a coûté {points} ; à partir de {expert}, rien.</translation>
        </message>
        <message>
            <source>{label}: {value} cost {points}; {expert} or less costs none.</source>
            <translation type="unfinished">{label} : {value} a coûté {points} ; jusqu’à {expert}, rien.</translation>
        </message>
        <message>
            <source>1 point</source>
            <translation type="unfinished">1 point</translation>
        </message>
        <message>
            <source>{n} points</source>
            <translation type="unfinished">{n} points</translation>
        </message>
        <message>
            <source> {metric} cost most: {points}.</source>
            <translation type="unfinished"> Le plus coûteux : {metric} ({points}).</translation>
        </message>
        <message>
            <source>Next: {title}.</source>
            <translation type="unfinished">Suite : {title}.</translation>
        </message>
        <message>
            <source> It follows in the course {course}.</source>
            <translation type="unfinished"> Il suit dans le cours {course}.</translation>
        </message>
        <message>
            <source> This one is passed; it is of level {level}.</source>
            <translation type="unfinished"> Celui-ci est réussi ; le suivant est de niveau {level}.</translation>
        </message>
        <message>
            <source> This one is passed; {metric} cost most here ({points}), and counts there.</source>
            <translation type="unfinished"> Celui-ci est réussi ; le plus coûteux ici est {metric} ({points}), et cela compte là-bas.</translation>
        </message>
        <message>
            <source>The same again: it is not passed yet.</source>
            <translation type="unfinished">Le même de nouveau : il n’est pas encore réussi.</translation>
        </message>
        <message>
            <source> {n} attempts in a row did not pass; this one is of level {level}.</source>
            <translation type="unfinished"> {n} essais de suite ont échoué ; celui-ci est de niveau {level}.</translation>
        </message>
        <message>
            <source>Now you: {title}.</source>
            <translation type="unfinished">À vous : {title}.</translation>
        </message>
        <message>
            <source>Then the whole exercise: {title}.</source>
            <translation type="unfinished">Ensuite l’exercice entier : {title}.</translation>
        </message>
        <message>
            <source>The same again: this attempt has no points.</source>
            <translation type="unfinished">Le même de nouveau : cet essai n’a pas de points.</translation>
        </message>
        <message>
            <source>All exercises that are open to you are passed.</source>
            <translation type="unfinished">Tous les exercices qui vous sont ouverts sont réussis.</translation>
        </message>
        <message>
            <source>not scored</source>
            <translation type="unfinished">non noté</translation>
        </message>
        <message>
            <source>{total:.0f} of 100 points</source>
            <translation type="unfinished">{total:.0f} points sur 100</translation>
        </message>
        <message>
            <source>▲ Void</source>
            <translation type="unfinished">▲ Nul</translation>
        </message>
        <message>
            <source>{why} It does not count.</source>
            <translation type="unfinished">{why} Il ne compte pas.</translation>
        </message>
        <message>
            <source>This attempt was not scored.</source>
            <translation type="unfinished">Cet essai n’a pas été noté.</translation>
        </message>
        <message>
            <source>✔ Passed</source>
            <translation type="unfinished">✔ Réussi</translation>
        </message>
        <message>
            <source>✔ Reached</source>
            <translation type="unfinished">✔ Atteint</translation>
        </message>
        <message>
            <source>Required and not met: {names}</source>
            <translation type="unfinished">Requis et non atteint : {names}</translation>
        </message>
        <message>
            <source>{mark:g} points are needed</source>
            <translation type="unfinished">Points nécessaires : {mark:g}</translation>
        </message>
        <message>
            <source>✖ Not passed</source>
            <translation type="unfinished">✖ Échoué</translation>
        </message>
        <message>
            <source>✖ Not reached yet</source>
            <translation type="unfinished">✖ Pas encore atteint</translation>
        </message>
        <message>
            <source>It counts for nothing. The pictures of the simulated cameras came too late: this computer was too busy. Close other programs, then try again.</source>
            <translation type="unfinished">Il ne compte pas. Les images des caméras simulées sont arrivées trop tard : cet ordinateur était trop occupé. Fermez d’autres programmes, puis réessayez.</translation>
        </message>
        <message>
            <source>It does not count and does not affect any average; fix what is named, if anything, and try again.</source>
            <translation type="unfinished">Il ne compte pas et ne change aucune moyenne ; corrigez ce qui est signalé, s’il y a lieu, et réessayez.</translation>
        </message>
        <message>
            <source>It counts for nothing. Let both cameras see the marker (the tab Cameras says what each one lacks: light, something before it, the colour), then try again.</source>
            <translation type="unfinished">Il ne compte pas. Faites que les deux caméras voient le marqueur (l’onglet Caméras dit ce qui manque à chacune : lumière, obstacle, couleur), puis réessayez.</translation>
        </message>
        <message>
            <source>Shown for information; it does not count.</source>
            <translation type="unfinished">Affiché pour information ; ne compte pas.</translation>
        </message>
        <message>
            <source>expert {expert:g}, good {good:g}, pass {passing:g} {unit}</source>
            <translation type="unfinished">expert {expert:g}, bon {good:g}, réussi {passing:g} {unit}</translation>
        </message>
        <message>
            <source>{n} days left</source>
            <translation type="unfinished">jours restants : {n}</translation>
        </message>
        <message>
            <source>void: {why}</source>
            <translation type="unfinished">nul : {why}</translation>
        </message>
        <message>
            <source>not released</source>
            <translation type="unfinished">non publié</translation>
        </message>
        <message>
            <source>cut off</source>
            <translation type="unfinished">interrompu</translation>
        </message>
        <message>
            <source>cut off: Recover closes it as it is</source>
            <translation type="unfinished">interrompu : Récupérer le clôt tel quel</translation>
        </message>
        <message>
            <source>deleted; can be brought back for {n} days</source>
            <translation type="unfinished">supprimé ; peut être rétabli (jours restants : {n})</translation>
        </message>
        <message>
            <source>deleted; can be brought back until the trash is emptied</source>
            <translation type="unfinished">supprimé ; peut être rétabli jusqu’à ce que la corbeille soit vidée</translation>
        </message>
        <message>
            <source>Student</source>
            <translation type="unfinished">Étudiant</translation>
        </message>
        <message>
            <source>Made with</source>
            <translation type="unfinished">Fait avec</translation>
        </message>
        <message>
            <source>Signature</source>
            <translation type="unfinished">Signature</translation>
        </message>
        <message>
            <source>void</source>
            <translation type="unfinished">nul</translation>
        </message>
        <message>
            <source>held</source>
            <translation type="unfinished">retenu</translation>
        </message>
        <message>
            <source>The instructor releases this result of the course {course}.</source>
            <translation type="unfinished">Le formateur publie ce résultat du cours {course}.</translation>
        </message>
        <message>
            <source>verified</source>
            <translation type="unfinished">vérifié</translation>
        </message>
        <message>
            <source>altered</source>
            <translation type="unfinished">altéré</translation>
        </message>
        <message>
            <source>unsigned</source>
            <translation type="unfinished">non signé</translation>
        </message>
        <message>
            <source>admitted</source>
            <translation type="unfinished">admis</translation>
        </message>
        <message>
            <source>Drill: {title}</source>
            <translation type="unfinished">Exercice ciblé : {title}</translation>
        </message>
        <message>
            <source>{title} (version {n})</source>
            <translation type="unfinished">{title} (version {n})</translation>
        </message>
        <message>
            <source>Open</source>
            <translation type="unfinished">Ouvrir</translation>
        </message>
        <message>
            <source>Delete</source>
            <translation type="unfinished">Supprimer</translation>
        </message>
        <message>
            <source>Undo delete</source>
            <translation type="unfinished">Annuler suppr.</translation>
        </message>
        <message>
            <source>Show deleted</source>
            <translation type="unfinished">Voir les supprimés</translation>
        </message>
        <message>
            <source>Bring back</source>
            <translation type="unfinished">Rétablir</translation>
        </message>
        <message>
            <source>{words}  ✕</source>
            <translation type="unfinished">{words}  ✕</translation>
        </message>
        <message>
            <source>Show all attempts again</source>
            <translation type="unfinished">Montrer de nouveau tous les essais</translation>
        </message>
        <message>
            <source>Back to the attempts</source>
            <translation type="unfinished">Retour aux essais</translation>
        </message>
        <message>
            <source>{n} deleted: Ctrl+Z here, or Show deleted, brings back</source>
            <translation type="unfinished">Supprimés : {n} ; Ctrl+Z ici, ou « Voir les supprimés », rétablit</translation>
        </message>
        <message>
            <source>{n} brought back</source>
            <translation type="unfinished">Rétablis : {n}</translation>
        </message>
        <message>
            <source>{n} recovered: listed as unfinished, without a score</source>
            <translation type="unfinished">Récupérés : {n}, listés comme inachevés, sans note</translation>
        </message>
        <message>
            <source>{n} discarded: Show deleted brings them back</source>
            <translation type="unfinished">Rejetés : {n} ; « Voir les supprimés » les rétablit</translation>
        </message>
        <message>
            <source>No sessions yet: begin an attempt, and it will be listed here.</source>
            <translation type="unfinished">Pas encore de séances : commencez un essai, et il figurera ici.</translation>
        </message>
        <message>
            <source>Nothing that was deleted is left.</source>
            <translation type="unfinished">Il ne reste rien de ce qui a été supprimé.</translation>
        </message>
        <message>
            <source>No attempt of these yet.</source>
            <translation type="unfinished">Pas encore d’essai de ceux-ci.</translation>
        </message>
        <message>
            <source>{shown} of {total} sessions</source>
            <translation type="unfinished">{shown} séances sur {total}</translation>
        </message>
        <message>
            <source>Filter by student, exercise, date, state…</source>
            <translation type="unfinished">Filtrer par étudiant, exercice, date, état…</translation>
        </message>
        <message>
            <source>Debrief with replay (double click, or Enter)</source>
            <translation type="unfinished">Débriefing avec relecture (double clic ou Entrée)</translation>
        </message>
        <message>
            <source>To the deleted ones, for {n} days at least (Del)</source>
            <translation type="unfinished">Vers les supprimés, pour au moins {n} jours (Suppr)</translation>
        </message>
        <message>
            <source>Bring the last deleted ones back (Ctrl+Z in the table)</source>
            <translation type="unfinished">Rétablir les derniers supprimés (Ctrl+Z dans le tableau)</translation>
        </message>
        <message>
            <source>The program was killed in this attempt: keep what was recorded, as unfinished</source>
            <translation type="unfinished">Le programme a été tué pendant cet essai : garder ce qui a été enregistré, comme inachevé</translation>
        </message>
        <message>
            <source>What was deleted, to be brought back</source>
            <translation type="unfinished">Ce qui a été supprimé, à rétablir</translation>
        </message>
        <message>
            <source>How the robot helps. To the right it guides the needle back to the planned path, to the left it pushes the needle away from it, which is harder to master; in the middle it does nothing. Arrow keys 1 %, Page keys 10 %, Home or double click: off.</source>
            <translation type="unfinished">Comment le robot aide. À droite, il ramène l’aiguille vers la trajectoire planifiée ; à gauche, il l’en repousse, ce qui est plus difficile à maîtriser ; au milieu, il ne fait rien. Flèches 1 %, touches Page 10 %, Début ou double clic : arrêt.</translation>
        </message>
        <message>
            <source>○ off</source>
            <translation type="unfinished">○ arrêt</translation>
        </message>
        <message>
            <source>▶◀ guides {percent} %</source>
            <translation type="unfinished">▶◀ guide {percent} %</translation>
        </message>
        <message>
            <source>◀▶ repels {percent} %</source>
            <translation type="unfinished">◀▶ repousse {percent} %</translation>
        </message>
        <message>
            <source>repel</source>
            <translation type="unfinished">repousser</translation>
        </message>
        <message>
            <source>off</source>
            <translation type="unfinished">arrêt</translation>
        </message>
        <message>
            <source>guide</source>
            <translation type="unfinished">guider</translation>
        </message>
        <message>
            <source>Force of the tissue along the needle, as the simulation has it: friction on the shaft. The robot cannot push along the needle; a simulated hand feels it.</source>
            <translation type="unfinished">Force du tissu le long de l’aiguille, selon la simulation : frottement sur la tige. Le robot ne peut pas pousser le long de l’aiguille ; une main simulée la ressent.</translation>
        </message>
        <message>
            <source>Bone crossed by {way:.1f} mm</source>
            <translation type="unfinished">Os traversé sur {way:.1f} mm</translation>
        </message>
        <message>
            <source>Along the needle: the tip stands on bone ▶</source>
            <translation type="unfinished">Le long de l’aiguille : la pointe bute sur l’os ▶</translation>
        </message>
        <message>
            <source>Force along the needle: not known</source>
            <translation type="unfinished">Force le long de l’aiguille : inconnue</translation>
        </message>
        <message>
            <source>Force along the needle: none</source>
            <translation type="unfinished">Force le long de l’aiguille : aucune</translation>
        </message>
        <message>
            <source>Along the needle: tissue pushes it out ▶</source>
            <translation type="unfinished">Le long de l’aiguille : le tissu la pousse dehors ▶</translation>
        </message>
        <message>
            <source>Along the needle: tissue holds it back ◀</source>
            <translation type="unfinished">Le long de l’aiguille : le tissu la retient ◀</translation>
        </message>
        <message>
            <source>An attempt is running: end it before another exercise is begun</source>
            <translation type="unfinished">Un essai est en cours : terminez-le avant d’en commencer un autre</translation>
        </message>
        <message>
            <source>There is no exercise {name} any more.</source>
            <translation type="unfinished">Il n’y a plus d’exercice {name}.</translation>
        </message>
        <message>
            <source>Place entry and target first: the expert follows your plan.</source>
            <translation type="unfinished">Placez d’abord le point d’entrée et la cible : l’expert suit votre plan.</translation>
        </message>
        <message>
            <source>The demonstration is coming …</source>
            <translation type="unfinished">La démonstration arrive …</translation>
        </message>
        <message>
            <source>Demonstration: a recorded attempt is led again</source>
            <translation type="unfinished">Démonstration : un essai enregistré est rejoué</translation>
        </message>
        <message>
            <source>Demonstration: a scripted expert has the needle</source>
            <translation type="unfinished">Démonstration : un expert automatique tient l’aiguille</translation>
        </message>
        <message>
            <source>Briefing of this exercise</source>
            <translation type="unfinished">Consignes de cet exercice</translation>
        </message>
        <message>
            <source>Show me this exercise</source>
            <translation type="unfinished">Montrez-moi cet exercice</translation>
        </message>
        <message>
            <source>level {n} of {most}</source>
            <translation type="unfinished">niveau {n} sur {most}</translation>
        </message>
        <message>
            <source>Assessment</source>
            <translation type="unfinished">Évaluation</translation>
        </message>
        <message>
            <source>{name}: stay {mm:g} mm away</source>
            <translation type="unfinished">{name} : restez à {mm:g} mm</translation>
        </message>
        <message>
            <source>{mark:g} of 100 points pass.</source>
            <translation type="unfinished">{mark:g} points sur 100 suffisent pour réussir.</translation>
        </message>
        <message>
            <source>{title}: best from {best}, passes from {passes}</source>
            <translation type="unfinished">{title} : parfait à partir de {best}, réussi à partir de {passes}</translation>
        </message>
        <message>
            <source>{title}: best up to {best}, passes up to {passes}</source>
            <translation type="unfinished">{title} : parfait jusqu’à {best}, réussi jusqu’à {passes}</translation>
        </message>
        <message>
            <source>; must be kept</source>
            <translation type="unfinished">; doit être respecté</translation>
        </message>
        <message>
            <source>{m}:{s:02d} min</source>
            <translation type="unfinished">{m}:{s:02d} min</translation>
        </message>
        <message>
            <source>the robot's help</source>
            <translation type="unfinished">l’aide du robot</translation>
        </message>
        <message>
            <source>what is shown</source>
            <translation type="unfinished">ce qui est affiché</translation>
        </message>
        <message>
            <source>window, slab and layout</source>
            <translation type="unfinished">fenêtrage, coupe épaisse et disposition</translation>
        </message>
        <message>
            <source>what moves the hand</source>
            <translation type="unfinished">ce qui déplace la main</translation>
        </message>
        <message>
            <source>the way effects are computed</source>
            <translation type="unfinished">la façon de calculer les effets</translation>
        </message>
        <message>
            <source>Nothing: you may change help, views and layout.</source>
            <translation type="unfinished">Rien : vous pouvez changer l’aide, les vues et la disposition.</translation>
        </message>
        <message>
            <source>Stays as it is: {what}.</source>
            <translation type="unfinished">Reste tel quel : {what}.</translation>
        </message>
        <message>
            <source>The robot helps less from attempt to attempt.</source>
            <translation type="unfinished">Le robot aide de moins en moins d’un essai à l’autre.</translation>
        </message>
        <message>
            <source>The robot helps less the better you do.</source>
            <translation type="unfinished">Mieux vous réussissez, moins le robot aide.</translation>
        </message>
        <message>
            <source>Every {n}th attempt is without any help.</source>
            <translation type="unfinished">Sans aucune aide : un essai sur {n}.</translation>
        </message>
        <message>
            <source>The robot guides with {share:.0f} %.</source>
            <translation type="unfinished">Le robot guide à {share:.0f} %.</translation>
        </message>
        <message>
            <source>The robot pushes off the path with {share:.0f} %.</source>
            <translation type="unfinished">Le robot repousse de la trajectoire à {share:.0f} %.</translation>
        </message>
        <message>
            <source>The robot does not help.</source>
            <translation type="unfinished">Le robot n’aide pas.</translation>
        </message>
        <message>
            <source>The hand moves the tool's handle: the tip goes the other way.</source>
            <translation type="unfinished">La main déplace la poignée de l’instrument : la pointe va dans l’autre sens.</translation>
        </message>
        <message>
            <source>The needle is seen on control scans alone (S): {n} slices of {mm:g} mm.</source>
            <translation type="unfinished">L’aiguille n’est visible que sur les scans de contrôle (S) ; coupes : {n} de {mm:g} mm.</translation>
        </message>
        <message>
            <source>Shown: {views}.</source>
            <translation type="unfinished">Affiché : {views}.</translation>
        </message>
        <message>
            <source>Any number of attempts.</source>
            <translation type="unfinished">Autant d’essais que l’on veut.</translation>
        </message>
        <message>
            <source>{n} attempts are allowed.</source>
            <translation type="unfinished">{n} essais sont permis.</translation>
        </message>
        <message>
            <source>1 attempt is allowed.</source>
            <translation type="unfinished">1 essai est permis.</translation>
        </message>
        <message>
            <source>{left} of {n} attempts are left.</source>
            <translation type="unfinished">Essais restants : {left} sur {n}.</translation>
        </message>
        <message>
            <source>The one attempt is left.</source>
            <translation type="unfinished">Il reste l’unique essai.</translation>
        </message>
        <message>
            <source>The one attempt is used.</source>
            <translation type="unfinished">L’unique essai est utilisé.</translation>
        </message>
        <message>
            <source>Course: {title}.</source>
            <translation type="unfinished">Cours : {title}.</translation>
        </message>
        <message>
            <source>Not now: {why}.</source>
            <translation type="unfinished">Pas maintenant : {why}.</translation>
        </message>
        <message>
            <source>Axial</source>
            <translation type="unfinished">Axiale</translation>
        </message>
        <message>
            <source>Coronal</source>
            <translation type="unfinished">Coronale</translation>
        </message>
        <message>
            <source>Sagittal</source>
            <translation type="unfinished">Sagittale</translation>
        </message>
        <message>
            <source>being made</source>
            <translation type="unfinished">en préparation</translation>
        </message>
        <message>
            <source>with the plan</source>
            <translation type="unfinished">avec le plan</translation>
        </message>
        <message>
            <source>The picture is being made …</source>
            <translation type="unfinished">L’image se prépare …</translation>
        </message>
        <message>
            <source>Begin (Enter)</source>
            <translation type="unfinished">Commencer (Entrée)</translation>
        </message>
        <message>
            <source>Show me (D)</source>
            <translation type="unfinished">Montrez-moi (D)</translation>
        </message>
        <message>
            <source>Look around first (L)</source>
            <translation type="unfinished">Regarder d’abord (L)</translation>
        </message>
        <message>
            <source>Back (Esc)</source>
            <translation type="unfinished">Retour (Échap)</translation>
        </message>
        <message>
            <source>Do not show this again for this exercise</source>
            <translation type="unfinished">Ne plus afficher pour cet exercice</translation>
        </message>
        <message>
            <source>The attempt starts as soon as robot and cameras are there</source>
            <translation type="unfinished">L’essai commence dès que le robot et les caméras sont là</translation>
        </message>
        <message>
            <source>An expert does the exercise; nothing is recorded</source>
            <translation type="unfinished">Un expert fait l’exercice ; rien n’est enregistré</translation>
        </message>
        <message>
            <source>Study the CT without the clock; F5 starts the attempt</source>
            <translation type="unfinished">Étudier le CT sans chronomètre ; F5 démarre l’essai</translation>
        </message>
        <message>
            <source>Insert the needle to the target.</source>
            <translation type="unfinished">Introduisez l’aiguille jusqu’à la cible.</translation>
        </message>
        <message>
            <source>Begin to plan (Enter)</source>
            <translation type="unfinished">Planifier (Entrée)</translation>
        </message>
        <message>
            <source>You choose the entry here, so there is nothing to show before you have.</source>
            <translation type="unfinished">Ici, vous choisissez le point d’entrée ; avant cela, il n’y a rien à montrer.</translation>
        </message>
        <message>
            <source>What is scored</source>
            <translation type="unfinished">Ce qui est noté</translation>
        </message>
        <message>
            <source>What helps</source>
            <translation type="unfinished">Ce qui aide</translation>
        </message>
        <message>
            <source>What is locked</source>
            <translation type="unfinished">Ce qui est verrouillé</translation>
        </message>
        <message>
            <source>Attempts</source>
            <translation type="unfinished">Essais</translation>
        </message>
        <message>
            <source>Depth bar</source>
            <translation type="unfinished">Barre de profondeur</translation>
        </message>
        <message>
            <source>Target {mm:.0f}</source>
            <translation type="unfinished">Cible {mm:.0f}</translation>
        </message>
        <message>
            <source>Skin 0 · Target {target:.0f} · Stop {stop:.0f} mm</source>
            <translation type="unfinished">Peau 0 · Cible {target:.0f} · Arrêt {stop:.0f} mm</translation>
        </message>
        <message>
            <source>Skin</source>
            <translation type="unfinished">Peau</translation>
        </message>
        <message>
            <source>Stop {mm:.0f}</source>
            <translation type="unfinished">Arrêt {mm:.0f}</translation>
        </message>
        <message>
            <source>patient left</source>
            <translation type="unfinished">la gauche du patient</translation>
        </message>
        <message>
            <source>patient right</source>
            <translation type="unfinished">la droite du patient</translation>
        </message>
        <message>
            <source>front</source>
            <translation type="unfinished">l’avant</translation>
        </message>
        <message>
            <source>back</source>
            <translation type="unfinished">l’arrière</translation>
        </message>
        <message>
            <source>head</source>
            <translation type="unfinished">la tête</translation>
        </message>
        <message>
            <source>feet</source>
            <translation type="unfinished">les pieds</translation>
        </message>
        <message>
            <source>In plane</source>
            <translation type="unfinished">Dans le plan</translation>
        </message>
        <message>
            <source>Out of plane</source>
            <translation type="unfinished">Hors du plan</translation>
        </message>
        <message>
            <source>Sideways</source>
            <translation type="unfinished">Latéral</translation>
        </message>
        <message>
            <source>Up / down</source>
            <translation type="unfinished">Haut / bas</translation>
        </message>
        <message>
            <source>{name}: ✔ on path</source>
            <translation type="unfinished">{name} : ✔ sur la trajectoire</translation>
        </message>
        <message>
            <source>{name}: {angle:.1f}° to {to}</source>
            <translation type="unfinished">{name} : {angle:.1f}° vers {to}</translation>
        </message>
        <message>
            <source>{name}: tilt the hub {angle:.1f}° towards {where}</source>
            <translation type="unfinished">{name} : inclinez l’embase de {angle:.1f}° vers {where}</translation>
        </message>
        <message>
            <source>{name}: tilt the tip {angle:.1f}° towards {where}</source>
            <translation type="unfinished">{name} : inclinez la pointe de {angle:.1f}° vers {where}</translation>
        </message>
        <message>
            <source>{length:.1f} mm off path</source>
            <translation type="unfinished">écart {length:.1f} mm</translation>
        </message>
        <message>
            <source>off the path: {length:.1f} mm</source>
            <translation type="unfinished">écart latéral : {length:.1f} mm</translation>
        </message>
        <message>
            <source>The dot is where the needle will pass the target: bring it into the middle. Rings: how far off, the inner two are the tolerance</source>
            <translation type="unfinished">Le point montre où l’aiguille passera la cible : amenez-le au milieu. Anneaux : de combien elle passe à côté ; les deux intérieurs sont la tolérance</translation>
        </message>
        <message>
            <source>{mm} mm off</source>
            <translation type="unfinished">écart {mm} mm</translation>
        </message>
        <message>
            <source>▼ {mm} mm</source>
            <translation type="unfinished">▼ {mm} mm</translation>
        </message>
        <message>
            <source>▲ {mm} mm</source>
            <translation type="unfinished">▲ {mm} mm</translation>
        </message>
        <message>
            <source>✔ hold</source>
            <translation type="unfinished">✔ tenir</translation>
        </message>
        <message>
            <source>CT angles: in plane {a} (path {b})
out of plane {c:+.1f}° (path {d:+.1f}°)</source>
            <translation type="unfinished">Angles CT : dans le plan {a} (trajectoire {b})
hors du plan {c:+.1f}° (trajectoire {d:+.1f}°)</translation>
        </message>
        <message>
            <source>✔ at target: hold ({gap:+.1f} mm)</source>
            <translation type="unfinished">✔ à la cible : tenez ({gap:+.1f} mm)</translation>
        </message>
        <message>
            <source>beside the target</source>
            <translation type="unfinished">à côté de la cible</translation>
        </message>
        <message>
            <source>▼ push {gap:.1f} mm</source>
            <translation type="unfinished">▼ avancez de {gap:.1f} mm</translation>
        </message>
        <message>
            <source>▲ too deep: pull {gap:.1f} mm</source>
            <translation type="unfinished">▲ trop profond : retirez de {gap:.1f} mm</translation>
        </message>
        <message>
            <source>Legend</source>
            <translation type="unfinished">Légende</translation>
        </message>
        <message>
            <source>Legend, shown or hidden</source>
            <translation type="unfinished">Légende, affichée ou masquée</translation>
        </message>
        <message>
            <source>◇ depth not measured now</source>
            <translation type="unfinished">◇ profondeur non mesurée</translation>
        </message>
        <message>
            <source>◇ not measured</source>
            <translation type="unfinished">◇ non mesurée</translation>
        </message>
        <message>
            <source>Camera picture</source>
            <translation type="unfinished">Image de la caméra</translation>
        </message>
        <message>
            <source>No picture</source>
            <translation type="unfinished">Pas d’image</translation>
        </message>
        <message>
            <source>marker not seen</source>
            <translation type="unfinished">marqueur non vu</translation>
        </message>
        <message>
            <source>{name}: {why}</source>
            <translation type="unfinished">{name} : {why}</translation>
        </message>
        <message>
            <source>left camera</source>
            <translation type="unfinished">caméra gauche</translation>
        </message>
        <message>
            <source>right camera</source>
            <translation type="unfinished">caméra droite</translation>
        </message>
        <message>
            <source>another patient was opened</source>
            <translation type="unfinished">un autre patient a été ouvert</translation>
        </message>
        <message>
            <source>The hand holds the tool's handle: the tip goes the other way.</source>
            <translation type="unfinished">La main tient la poignée de l’instrument : la pointe va dans l’autre sens.</translation>
        </message>
        <message>
            <source>Choose an exercise first.</source>
            <translation type="unfinished">Choisissez d’abord un exercice.</translation>
        </message>
        <message>
            <source>Control scans guide here: nothing shows the needle between them.</source>
            <translation type="unfinished">Ici, les scans de contrôle guident : entre eux, rien ne montre l’aiguille.</translation>
        </message>
        <message>
            <source>Views can be switched between attempts.</source>
            <translation type="unfinished">Les vues se changent entre les essais.</translation>
        </message>
        <message>
            <source>This assessment is made for another CT than the one that is open: begin it from the start page, which opens its own.</source>
            <translation type="unfinished">Cette évaluation est faite pour un autre CT que celui qui est ouvert : commencez-la depuis la page d’accueil, qui ouvre le sien.</translation>
        </message>
        <message>
            <source>The CT in {folder} is not the one the exercise was made on, or was read differently: put the right one there, or make the exercise again on this one.</source>
            <translation type="unfinished">Le CT dans {folder} n’est pas celui sur lequel l’exercice a été fait, ou il a été lu autrement : mettez-y le bon, ou refaites l’exercice sur celui-ci.</translation>
        </message>
        <message>
            <source>The needle is not there yet.</source>
            <translation type="unfinished">L’aiguille n’est pas encore là.</translation>
        </message>
        <message>
            <source>✖ robot not ready</source>
            <translation type="unfinished">✖ robot pas prêt</translation>
        </message>
        <message>
            <source>why, and what to do: Robot's health (F8)</source>
            <translation type="unfinished">pourquoi, et que faire : État du robot (F8)</translation>
        </message>
        <message>
            <source>– forces off</source>
            <translation type="unfinished">– forces coupées</translation>
        </message>
        <message>
            <source>start the attempt first</source>
            <translation type="unfinished">démarrez d’abord l’essai</translation>
        </message>
        <message>
            <source>let go of {key}</source>
            <translation type="unfinished">relâchez {key}</translation>
        </message>
        <message>
            <source>hold {key} again</source>
            <translation type="unfinished">maintenez de nouveau {key}</translation>
        </message>
        <message>
            <source>✖ no force: {todo}</source>
            <translation type="unfinished">✖ pas de force : {todo}</translation>
        </message>
        <message>
            <source>○ forces off</source>
            <translation type="unfinished">○ forces coupées</translation>
        </message>
        <message>
            <source>◐ switching on {percent:.0f} %</source>
            <translation type="unfinished">◐ mise en marche {percent:.0f} %</translation>
        </message>
        <message>
            <source>keep holding {key}</source>
            <translation type="unfinished">continuez à maintenir {key}</translation>
        </message>
        <message>
            <source>● FORCES ON</source>
            <translation type="unfinished">● FORCES ACTIVES</translation>
        </message>
        <message>
            <source>let go of {key}: forces off</source>
            <translation type="unfinished">relâchez {key} : forces coupées</translation>
        </message>
        <message>
            <source>hold {key}, pedal or this button to switch on</source>
            <translation type="unfinished">maintenez {key}, la pédale ou ce bouton pour activer</translation>
        </message>
        <message>
            <source>The robot gives force only while {key}, a pedal or this button is held; the force rises within a second and is gone when you let go, or when the window loses the keyboard. After a fault let go and hold again.</source>
            <translation type="unfinished">Le robot n’exerce de force que tant que {key}, une pédale ou ce bouton est maintenu ; la force monte en une seconde et disparaît quand vous relâchez, ou quand la fenêtre perd le clavier. Après un défaut, relâchez et maintenez de nouveau.</translation>
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
            <translation type="unfinished">pas de bilan d’énergie</translation>
        </message>
        <message>
            <source>force at {share:.0f} %</source>
            <translation type="unfinished">force à {share:.0f} %</translation>
        </message>
        <message>
            <source>damping added</source>
            <translation type="unfinished">amortissement ajouté</translation>
        </message>
        <message>
            <source>guard acts: {what}</source>
            <translation type="unfinished">garde active : {what}</translation>
        </message>
        <message>
            <source>tank nearly empty</source>
            <translation type="unfinished">réserve presque vide</translation>
        </message>
        <message>
            <source>guard at rest</source>
            <translation type="unfinished">garde au repos</translation>
        </message>
        <message>
            <source>Energy of the robot's force. Filled: what the force laws store now, as springs do. Line: what may still be let out to the hand, of the most they have declared. When it runs out, the guard weakens or damps the force, so that the robot cannot run away; that is no fault. If it acts often, lower the assistance, or look at the loop's lateness.</source>
            <translation type="unfinished">Énergie de la force du robot. Rempli : ce que les lois de force stockent maintenant, comme des ressorts. Trait : ce qui peut encore être cédé à la main, sur le maximum qu’elles ont déclaré. Quand il s’épuise, la garde affaiblit ou amortit la force, pour que le robot ne puisse pas s’emballer ; ce n’est pas un défaut. Si elle agit souvent, baissez l’assistance, ou voyez le retard de la boucle de commande.</translation>
        </message>
        <message>
            <source>Energy</source>
            <translation type="unfinished">Énergie</translation>
        </message>
        <message>
            <source>stored –</source>
            <translation type="unfinished">stockée –</translation>
        </message>
        <message>
            <source>left –</source>
            <translation type="unfinished">restante –</translation>
        </message>
        <message>
            <source>removed by the guard –</source>
            <translation type="unfinished">retirée par la garde –</translation>
        </message>
        <message>
            <source>stored {energy}</source>
            <translation type="unfinished">stockée {energy}</translation>
        </message>
        <message>
            <source>left {tank} of {bound}</source>
            <translation type="unfinished">restante {tank} sur {bound}</translation>
        </message>
        <message>
            <source>removed {energy}</source>
            <translation type="unfinished">retirée {energy}</translation>
        </message>
        <message>
            <source>Energy of the force</source>
            <translation type="unfinished">Énergie de la force</translation>
        </message>
        <message>
            <source>An attempt is running: end it first, then change {what}.</source>
            <translation type="unfinished">Un essai est en cours : terminez-le d’abord, puis changez {what}.</translation>
        </message>
        <message>
            <source>the robot</source>
            <translation type="unfinished">le robot</translation>
        </message>
        <message>
            <source>Go on with the attempt</source>
            <translation type="unfinished">Poursuivre l’essai</translation>
        </message>
        <message>
            <source>End it and quit</source>
            <translation type="unfinished">Terminer et quitter</translation>
        </message>
        <message>
            <source>Quit</source>
            <translation type="unfinished">Quitter</translation>
        </message>
        <message>
            <source>An attempt is running. End it and quit?</source>
            <translation type="unfinished">Un essai est en cours. Le terminer et quitter ?</translation>
        </message>
        <message>
            <source>It ends without a score; what is recorded so far stays.</source>
            <translation type="unfinished">Il se termine sans note ; ce qui est déjà enregistré reste.</translation>
        </message>
        <message>
            <source>Start has to wait: earlier attempts are being looked up.</source>
            <translation type="unfinished">Le départ doit attendre : les essais antérieurs sont recherchés.</translation>
        </message>
        <message>
            <source>This attempt is a probe: without help, as in an assessment.</source>
            <translation type="unfinished">Cet essai est un essai témoin : sans aide, comme dans une évaluation.</translation>
        </message>
        <message>
            <source>Assistance of this attempt: {share} %</source>
            <translation type="unfinished">Assistance de cet essai : {share} %</translation>
        </message>
        <message>
            <source>{title} (not kept)</source>
            <translation type="unfinished">{title} (non conservé)</translation>
        </message>
        <message>
            <source>There is no exercise {name}; there are: {names}</source>
            <translation type="unfinished">Il n’y a pas d’exercice {name} ; il y a : {names}</translation>
        </message>
        <message>
            <source>An attempt is running: end it before another exercise is chosen</source>
            <translation type="unfinished">Un essai est en cours : terminez-le avant de choisir un autre exercice</translation>
        </message>
        <message>
            <source>Same plan, or a new one?</source>
            <translation type="unfinished">Même plan, ou un nouveau ?</translation>
        </message>
        <message>
            <source>The plan of an attempt stays in its record.</source>
            <translation type="unfinished">Le plan d’un essai reste dans son enregistrement.</translation>
        </message>
        <message>
            <source>Same plan</source>
            <translation type="unfinished">Même plan</translation>
        </message>
        <message>
            <source>New plan</source>
            <translation type="unfinished">Nouveau plan</translation>
        </message>
        <message>
            <source>guidance limited to {n:.1f} N here</source>
            <translation type="unfinished">guidage limité ici à {n:.1f} N</translation>
        </message>
        <message>
            <source>the needle sticks out far, and the motors cannot push harder at so long a lever</source>
            <translation type="unfinished">l’aiguille dépasse beaucoup, et les moteurs ne peuvent pousser plus fort à un levier si long</translation>
        </message>
        <message>
            <source>the depth is not measured; the robot keeps within its limits for every depth, and where the needle sticks out furthest no more than this reaches your hand</source>
            <translation type="unfinished">la profondeur n’est pas mesurée ; le robot reste dans ses limites pour toute profondeur, et là où l’aiguille dépasse le plus, votre main ne reçoit pas plus que cela</translation>
        </message>
        <message>
            <source>the depth is known only to ± {mm:.0f} mm, and the force stays within its limit for all of that</source>
            <translation type="unfinished">la profondeur n’est connue qu’à ± {mm:.0f} mm près, et la force reste sous sa limite sur toute cette plage</translation>
        </message>
        <message>
            <source>the lever is light here: a stronger push could not be stopped in time if you let go</source>
            <translation type="unfinished">le levier est léger ici : une poussée plus forte ne pourrait être arrêtée à temps si vous lâchiez</translation>
        </message>
        <message>
            <source>at most {force:.1f} N</source>
            <translation type="unfinished">au plus {force:.1f} N</translation>
        </message>
        <message>
            <source>{force:.1f} N {origin}</source>
            <translation type="unfinished">{force:.1f} N {origin}</translation>
        </message>
        <message>
            <source>measured</source>
            <translation type="unfinished">mesurée</translation>
        </message>
        <message>
            <source>estimated</source>
            <translation type="unfinished">estimée</translation>
        </message>
        <message>
            <source>The depth is not measured, and the force at the hand depends on it: this is the largest that it can be, estimated from the motor torques; what you feel may be less.</source>
            <translation type="unfinished">La profondeur n’est pas mesurée, et la force à la main en dépend : voici la plus grande possible, estimée d’après les couples des moteurs ; ce que vous ressentez peut être moindre.</translation>
        </message>
        <message>
            <source>Force at the hand, measured by the robot's own gauge, across the needle.</source>
            <translation type="unfinished">Force à la main, mesurée par le capteur du robot, en travers de l’aiguille.</translation>
        </message>
        <message>
            <source>Force at the hand, estimated from the motor torques that are sent: no force sensor says what really arrives.</source>
            <translation type="unfinished">Force à la main, estimée d’après les couples envoyés aux moteurs : aucun capteur de force ne dit ce qui arrive vraiment.</translation>
        </message>
        <message>
            <source>mouse, keys</source>
            <translation type="unfinished">souris, clavier</translation>
        </message>
        <message>
            <source>pen tablet</source>
            <translation type="unfinished">tablette graphique</translation>
        </message>
        <message>
            <source>Drag or arrows: move the handle, and the tip goes the other way  ·  wheel away from you, Page Down, right button: push; hold: go on  ·  Shift: finer</source>
            <translation type="unfinished">Glisser ou flèches : déplacer la poignée, la pointe va dans l’autre sens  ·  molette vers l’avant, Page suiv., bouton droit : avancer ; maintenir : continuer  ·  Maj : plus fin</translation>
        </message>
        <message>
            <source>Drag or arrows: tilt  ·  wheel away from you, Page Down, right button: push; hold: go on  ·  Shift: finer  ·  Home: hand to needle</source>
            <translation type="unfinished">Glisser ou flèches : incliner  ·  molette vers l’avant, Page suiv., bouton droit : avancer ; maintenir : continuer  ·  Maj : plus fin  ·  Début : main à l’aiguille</translation>
        </message>
        <message>
            <source>Hold the pen like the needle, its point on the pad: lean it to tilt  ·  press: push in, with the side button: pull  ·  wheel or Page keys: 1 mm</source>
            <translation type="unfinished">Tenez le stylo comme l’aiguille, sa pointe sur le pavé : penchez-le pour incliner  ·  appuyer : avancer, avec le bouton latéral : retirer  ·  molette ou touches Page : 1 mm</translation>
        </message>
        <message>
            <source>Left stick: tilt  ·  right stick away from you: push in, towards you: pull  ·  A: hand to needle</source>
            <translation type="unfinished">Stick gauche : incliner  ·  stick droit vers l’avant : avancer, vers vous : retirer  ·  A : main à l’aiguille</translation>
        </message>
        <message>
            <source>You hold the needle. The simulated cameras cannot see how deep it is: say it by wheel or Page keys, 1 mm  ·  Shift: finer</source>
            <translation type="unfinished">Vous tenez l’aiguille. Les caméras simulées ne voient pas sa profondeur : indiquez-la par la molette ou les touches Page, 1 mm  ·  Maj : plus fin</translation>
        </message>
        <message>
            <source>Which end goes where mouse, keys or stick go, as the bull's-eye shows it. The tip: to the right is to the right. The hub: as the real needle turns about the skin, hub to the right brings the tip to the left.</source>
            <translation type="unfinished">Quel bout suit la souris, les touches ou le stick, comme le montre la cible de visée. La pointe : à droite, c’est à droite. L’embase : comme la vraie aiguille pivote autour de la peau, l’embase à droite amène la pointe à gauche.</translation>
        </message>
        <message>
            <source>moves the tip</source>
            <translation type="unfinished">déplace la pointe</translation>
        </message>
        <message>
            <source>moves the hub</source>
            <translation type="unfinished">déplace l’embase</translation>
        </message>
        <message>
            <source>The hand moves</source>
            <translation type="unfinished">La main déplace</translation>
        </message>
        <message>
            <source>How far the hand moves when mouse, pen or stick moves</source>
            <translation type="unfinished">De combien la main bouge quand bouge la souris, le stylo ou le stick</translation>
        </message>
        <message>
            <source>fine</source>
            <translation type="unfinished">fin</translation>
        </message>
        <message>
            <source>normal</source>
            <translation type="unfinished">normal</translation>
        </message>
        <message>
            <source>direct</source>
            <translation type="unfinished">direct</translation>
        </message>
        <message>
            <source>▼ push</source>
            <translation type="unfinished">▼ avancer</translation>
        </message>
        <message>
            <source>▲ pull</source>
            <translation type="unfinished">▲ retirer</translation>
        </message>
        <message>
            <source>Hold to push the needle in. So do: wheel away from you, Page Down, right button</source>
            <translation type="unfinished">Maintenez pour avancer l’aiguille. De même : molette vers l’avant, Page suiv., bouton droit</translation>
        </message>
        <message>
            <source>Hold to pull the needle. So do: wheel towards you, Page Up, middle button</source>
            <translation type="unfinished">Maintenez pour retirer l’aiguille. De même : molette vers vous, Page préc., bouton du milieu</translation>
        </message>
        <message>
            <source>no gamepad: plug one in</source>
            <translation type="unfinished">pas de manette : branchez-en une</translation>
        </message>
        <message>
            <source>waiting for the pen over the pad</source>
            <translation type="unfinished">attend le stylo au-dessus du pavé</translation>
        </message>
        <message>
            <source>this pen reports no tilt: move it instead</source>
            <translation type="unfinished">ce stylo n’indique pas d’inclinaison : déplacez-le plutôt</translation>
        </message>
        <message>
            <source>Bull's-eye pad</source>
            <translation type="unfinished">Pavé de la cible de visée</translation>
        </message>
        <message>
            <source>No planned path</source>
            <translation type="unfinished">Pas de trajectoire planifiée</translation>
        </message>
        <message>
            <source>Move the hand here: it is not shown</source>
            <translation type="unfinished">Bougez la main ici : l’aiguille n’est pas affichée</translation>
        </message>
        <message>
            <source>Rings: {sizes}</source>
            <translation type="unfinished">Anneaux : {sizes}</translation>
        </message>
        <message>
            <source>Start attempt</source>
            <translation type="unfinished">Démarrer l’essai</translation>
        </message>
        <message>
            <source>Control scan (S)</source>
            <translation type="unfinished">Scan de contrôle (S)</translation>
        </message>
        <message>
            <source>End attempt (Enter)</source>
            <translation type="unfinished">Terminer l’essai (Entrée)</translation>
        </message>
        <message>
            <source>The needle stays as it is and is scored</source>
            <translation type="unfinished">L’aiguille reste telle quelle et est notée</translation>
        </message>
        <message>
            <source>Abort (hold Esc)</source>
            <translation type="unfinished">Abandon (tenir Échap)</translation>
        </message>
        <message>
            <source>Set the force to zero at once; the attempt is saved but not scored</source>
            <translation type="unfinished">Met aussitôt la force à zéro ; l’essai est enregistré mais non noté</translation>
        </message>
        <message>
            <source>Arm the robot and begin recording (F5)</source>
            <translation type="unfinished">Armer le robot et commencer l’enregistrement (F5)</translation>
        </message>
        <message>
            <source>Counts a scan and keeps the needle's place with it</source>
            <translation type="unfinished">Compte un scan et garde avec lui la position de l’aiguille</translation>
        </message>
        <message>
            <source>The pedal: takes the slices that are set below, with the needle where it is now</source>
            <translation type="unfinished">La pédale : prend les coupes réglées ci-dessous, avec l’aiguille là où elle est</translation>
        </message>
        <message>
            <source>The needle is out</source>
            <translation type="unfinished">L’aiguille est sortie</translation>
        </message>
        <message>
            <source>Recorded as your word, not as measured; a depth inside the skin refutes it</source>
            <translation type="unfinished">Enregistré comme votre parole, non comme mesuré ; une profondeur sous la peau le réfute</translation>
        </message>
        <message>
            <source>Bevel turned by {angle:.0f}°</source>
            <translation type="unfinished">Biseau tourné de {angle:.0f}°</translation>
        </message>
        <message>
            <source>{n} of {of} touched</source>
            <translation type="unfinished">touchées : {n} sur {of}</translation>
        </message>
        <message>
            <source>{mm:.0f} mm to target {n}</source>
            <translation type="unfinished">{mm:.0f} mm jusqu’à la cible {n}</translation>
        </message>
        <message>
            <source>the tip is not through the trocar yet: push</source>
            <translation type="unfinished">la pointe n’a pas encore passé le trocart : avancez</translation>
        </message>
        <message>
            <source>1 mm of hand moves the tip {mm:.1f} mm, the other way</source>
            <translation type="unfinished">1 mm de la main déplace la pointe de {mm:.1f} mm, dans l’autre sens</translation>
        </message>
        <message>
            <source>Breathe in, breathe out, hold: until you let him breathe</source>
            <translation type="unfinished">Inspirez, expirez, ne respirez plus : jusqu’à ce que vous le laissiez respirer</translation>
        </message>
        <message>
            <source>Hold the breath (A)</source>
            <translation type="unfinished">Demander l’apnée (A)</translation>
        </message>
        <message>
            <source>Let breathe (A)</source>
            <translation type="unfinished">Laisser respirer (A)</translation>
        </message>
        <message>
            <source>holds: {s:.0f} s left</source>
            <translation type="unfinished">apnée : encore {s:.0f} s</translation>
        </message>
        <message>
            <source>breathes by himself</source>
            <translation type="unfinished">respire de lui-même</translation>
        </message>
        <message>
            <source>Release (A)</source>
            <translation type="unfinished">Relâcher (A)</translation>
        </message>
        <message>
            <source>breathes out and holds</source>
            <translation type="unfinished">expire et bloque</translation>
        </message>
        <message>
            <source>breathes</source>
            <translation type="unfinished">respire</translation>
        </message>
        <message>
            <source>Assistance
fixed</source>
            <translation type="unfinished">Assistance
fixe</translation>
        </message>
        <message>
            <source>Assistance
free to turn</source>
            <translation type="unfinished">Assistance
réglable</translation>
        </message>
        <message>
            <source>Practice: you may turn the dial. Every attempt begins with the exercise's own.</source>
            <translation type="unfinished">Entraînement : vous pouvez tourner le réglage. Chaque essai commence avec celui de l’exercice.</translation>
        </message>
        <message>
            <source>Robot and cameras are being started: an attempt can begin in a moment.</source>
            <translation type="unfinished">Le robot et les caméras démarrent : un essai pourra commencer dans un instant.</translation>
        </message>
        <message>
            <source>anonymous (instructor signed in)</source>
            <translation type="unfinished">anonyme (formateur connecté)</translation>
        </message>
        <message>
            <source>anonymous</source>
            <translation type="unfinished">anonyme</translation>
        </message>
        <message>
            <source>A pseudonym, never a name: it goes into every record. Letters, digits, . _ -</source>
            <translation type="unfinished">Un pseudonyme, jamais un nom : il va dans chaque enregistrement. Lettres, chiffres, . _ -</translation>
        </message>
        <message>
            <source>no cameras</source>
            <translation type="unfinished">pas de caméras</translation>
        </message>
        <message>
            <source>marker out of view (both cameras)</source>
            <translation type="unfinished">marqueur hors de vue (deux caméras)</translation>
        </message>
        <message>
            <source>marker still in the tube</source>
            <translation type="unfinished">marqueur encore dans le tube</translation>
        </message>
        <message>
            <source>a picture is late</source>
            <translation type="unfinished">une image est en retard</translation>
        </message>
        <message>
            <source>marker out of view ({cameras})</source>
            <translation type="unfinished">marqueur hors de vue ({cameras})</translation>
        </message>
        <message>
            <source>the cameras disagree</source>
            <translation type="unfinished">les caméras se contredisent</translation>
        </message>
        <message>
            <source>fault {code}: no force</source>
            <translation type="unfinished">défaut {code} : pas de force</translation>
        </message>
        <message>
            <source>The line is the largest force the device may give now.</source>
            <translation type="unfinished">Le trait est la plus grande force que l’appareil peut donner maintenant.</translation>
        </message>
        <message>
            <source>{limit}: {reason}</source>
            <translation type="unfinished">{limit} : {reason}</translation>
        </message>
        <message>
            <source>limit {limit:g} N</source>
            <translation type="unfinished">limite {limit:g} N</translation>
        </message>
        <message>
            <source>Force felt</source>
            <translation type="unfinished">Force ressentie</translation>
        </message>
        <message>
            <source>Since the start of the attempt</source>
            <translation type="unfinished">Depuis le début de l’essai</translation>
        </message>
        <message>
            <source>Depth</source>
            <translation type="unfinished">Profondeur</translation>
        </message>
        <message>
            <source>Tip beyond the entry, along the needle; ◇ when it is not measured now</source>
            <translation type="unfinished">Pointe au-delà du point d’entrée, le long de l’aiguille ; ◇ quand elle n’est pas mesurée</translation>
        </message>
        <message>
            <source>Angle error</source>
            <translation type="unfinished">Erreur d’angle</translation>
        </message>
        <message>
            <source>Between the needle and the planned path</source>
            <translation type="unfinished">Entre l’aiguille et la trajectoire planifiée</translation>
        </message>
        <message>
            <source>Off the path</source>
            <translation type="unfinished">Écart latéral</translation>
        </message>
        <message>
            <source>Tip from the line of the planned path</source>
            <translation type="unfinished">De la pointe à la ligne de la trajectoire planifiée</translation>
        </message>
        <message>
            <source>To target</source>
            <translation type="unfinished">Jusqu’à la cible</translation>
        </message>
        <message>
            <source>Along the path; negative when the tip is too deep</source>
            <translation type="unfinished">Le long de la trajectoire ; négatif quand la pointe est trop profonde</translation>
        </message>
        <message>
            <source>Tip known to</source>
            <translation type="unfinished">Pointe connue à</translation>
        </message>
        <message>
            <source>Radius round the tip that holds the true one with 95 %, as it is shown now</source>
            <translation type="unfinished">Rayon autour de la pointe affichée qui contient la vraie à 95 %</translation>
        </message>
        <message>
            <source>Bending</source>
            <translation type="unfinished">Flexion</translation>
        </message>
        <message>
            <source>Tip off the straight needle, by tissue or cameras; less than chance is shown as &lt;</source>
            <translation type="unfinished">Écart de la pointe à l’aiguille droite, dû au tissu ou aux caméras ; moins que le hasard s’affiche par &lt;</translation>
        </message>
        <message>
            <source>Scans taken in this attempt</source>
            <translation type="unfinished">Scans pris dans cet essai</translation>
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
            <translation type="unfinished">la fenêtre a été fermée</translation>
        </message>
        <message>
            <source>Starting robot and cameras</source>
            <translation type="unfinished">Démarrage du robot et des caméras</translation>
        </message>
        <message>
            <source>scanning…</source>
            <translation type="unfinished">scan en cours…</translation>
        </message>
        <message>
            <source>{low} to {high}</source>
            <translation type="unfinished">{low} à {high}</translation>
        </message>
        <message>
            <source>Scans: {n} · {dose:.1f} mGy·cm ({estimate})</source>
            <translation type="unfinished">Scans : {n} · {dose:.1f} mGy·cm ({estimate})</translation>
        </message>
        <message>
            <source>Middle of the scan along the patient (z of LPS): + is headwards</source>
            <translation type="unfinished">Milieu du scan le long du patient (z en LPS) : + est vers la tête</translation>
        </message>
        <message>
            <source>Table position</source>
            <translation type="unfinished">Position de la table</translation>
        </message>
        <message>
            <source>One slice towards the feet</source>
            <translation type="unfinished">Une coupe vers les pieds</translation>
        </message>
        <message>
            <source>One slice towards the head</source>
            <translation type="unfinished">Une coupe vers la tête</translation>
        </message>
        <message>
            <source>At crosshair</source>
            <translation type="unfinished">Au réticule</translation>
        </message>
        <message>
            <source>Move the table to the axial slice that is shown</source>
            <translation type="unfinished">Amène la table à la coupe axiale affichée</translation>
        </message>
        <message>
            <source>Dose-length product as the exercise sets it: a teaching estimate, no dose of any scanner</source>
            <translation type="unfinished">Produit dose-longueur fixé par l’exercice : estimation pédagogique, non la dose d’un scanner</translation>
        </message>
        <message>
            <source>Control scan</source>
            <translation type="unfinished">Scan de contrôle</translation>
        </message>
        <message>
            <source>Table</source>
            <translation type="unfinished">Table</translation>
        </message>
        <message>
            <source>All slices</source>
            <translation type="unfinished">Toutes les coupes</translation>
        </message>
        <message>
            <source>No control scan yet.
Set table and slices, then press the pedal (S).</source>
            <translation type="unfinished">Pas encore de scan de contrôle.
Réglez table et coupes, puis appuyez sur la pédale (S).</translation>
        </message>
        <message>
            <source>Control scan {n} at {time:.0f} s · {slices} × {mm:g} mm · {dose:.1f} mGy·cm ({estimate})</source>
            <translation type="unfinished">Scan de contrôle {n} à {time:.0f} s · {slices} × {mm:g} mm · {dose:.1f} mGy·cm ({estimate})</translation>
        </message>
        <message>
            <source>Messages</source>
            <translation type="unfinished">Messages</translation>
        </message>
        <message>
            <source>Click: with details, or without</source>
            <translation type="unfinished">Clic : avec ou sans détails</translation>
        </message>
        <message>
            <source>Status</source>
            <translation type="unfinished">Statut</translation>
        </message>
        <message>
            <source>{rate:.0f} Hz · late {median:.2f} / {p99:.2f} ms · {missing:.1f} % missed</source>
            <translation type="unfinished">{rate:.0f} Hz · retard {median:.2f} / {p99:.2f} ms · {missing:.1f} % manqués</translation>
        </message>
        <message>
            <source>Robot loop</source>
            <translation type="unfinished">Boucle de commande</translation>
        </message>
        <message>
            <source>Rate of the force loop, its lateness (median / 99th percentile) and the share of deadlines it missed in the last {seconds:.0f} s; since the start it missed {missed} of {ticks}. If it is late, close other programs; forces stay limited either way.</source>
            <translation type="unfinished">Cadence de la boucle de force, son retard (médiane / 99e centile) et la part des échéances manquées dans les dernières {seconds:.0f} s ; depuis le début, manquées : {missed} sur {ticks}. Si elle est en retard, fermez d’autres programmes ; les forces restent limitées de toute façon.</translation>
        </message>
        <message>
            <source>fault: no force</source>
            <translation type="unfinished">défaut : pas de force</translation>
        </message>
        <message>
            <source>Encoders</source>
            <translation type="unfinished">Codeurs</translation>
        </message>
        <message>
            <source>Age of the robot's joint angles. The force fades from 20 ms and is zero from 100 ms. If it stays old, check the robot's cable and power, then start the attempt again.</source>
            <translation type="unfinished">Âge des angles articulaires du robot. La force décroît dès 20 ms et est nulle dès 100 ms. S’il reste élevé, vérifiez le câble et l’alimentation du robot, puis redémarrez l’essai.</translation>
        </message>
        <message>
            <source>{rate:.0f} Hz · {share:.0f} % valid · {age}</source>
            <translation type="unfinished">{rate:.0f} Hz · {share:.0f} % valides · {age}</translation>
        </message>
        <message>
            <source>Rate of the tracker, share of pictures in which both cameras saw the marker, age of the last such fix. If the marker is out of view, bring it back between the cameras; look at the camera pictures for dirt, light or something in the way.</source>
            <translation type="unfinished">Cadence du suivi, part des images où les deux caméras ont vu le marqueur, âge de la dernière mesure de ce genre. Si le marqueur est hors de vue, ramenez-le entre les caméras ; cherchez sur les images des caméras saleté, lumière ou obstacle.</translation>
        </message>
        <message>
            <source>see the marker</source>
            <translation type="unfinished">voient le marqueur</translation>
        </message>
        <message>
            <source>from the cameras</source>
            <translation type="unfinished">par les caméras</translation>
        </message>
        <message>
            <source>from one camera</source>
            <translation type="unfinished">par une caméra</translation>
        </message>
        <message>
            <source>held, {age} old</source>
            <translation type="unfinished">maintenue, âge {age}</translation>
        </message>
        <message>
            <source>unknown</source>
            <translation type="unfinished">inconnue</translation>
        </message>
        <message>
            <source>The depth is measured by the cameras; by one of them and the needle's line, less exactly, while the other does not see the marker. Without a fix it is held for 200 ms. After that, and until ten pictures in a row agree, nobody knows it: the force is held back for the worst depth that the needle can have. Wait until the cameras see the marker again.</source>
            <translation type="unfinished">La profondeur est mesurée par les caméras ; par l’une d’elles et la ligne de l’aiguille, moins précisément, tant que l’autre ne voit pas le marqueur. Sans mesure, elle est maintenue 200 ms. Ensuite, et jusqu’à ce que dix images de suite concordent, nul ne la connaît : la force est retenue pour la profondeur la plus défavorable possible. Attendez que les caméras revoient le marqueur.</translation>
        </message>
        <message>
            <source>Heartbeat</source>
            <translation type="unfinished">Signe de vie</translation>
        </message>
        <message>
            <source>The window's sign of life to the robot. After 1 s without one the force goes to zero. If it stops, the window is frozen: wait, or end the program.</source>
            <translation type="unfinished">Le signe de vie de la fenêtre au robot. Après 1 s sans lui, la force tombe à zéro. S’il cesse, la fenêtre est figée : attendez, ou quittez le programme.</translation>
        </message>
        <message>
            <source>Robot ready</source>
            <translation type="unfinished">Robot prêt</translation>
        </message>
        <message>
            <source>Robot held back: {why}</source>
            <translation type="unfinished">Robot retenu : {why}</translation>
        </message>
        <message>
            <source>Robot stopped: {why}</source>
            <translation type="unfinished">Robot arrêté : {why}</translation>
        </message>
        <message>
            <source>see the marker now and then</source>
            <translation type="unfinished">voient le marqueur par moments</translation>
        </message>
        <message>
            <source>do not see the marker</source>
            <translation type="unfinished">ne voient pas le marqueur</translation>
        </message>
        <message>
            <source>There are no cameras here: the depth comes from elsewhere, or from nowhere.</source>
            <translation type="unfinished">Il n’y a pas de caméras ici : la profondeur vient d’ailleurs, ou de nulle part.</translation>
        </message>
        <message>
            <source>measured a moment ago</source>
            <translation type="unfinished">mesurée il y a un instant</translation>
        </message>
        <message>
            <source>No robot</source>
            <translation type="unfinished">Pas de robot</translation>
        </message>
        <message>
            <source>it does not answer</source>
            <translation type="unfinished">il ne répond pas</translation>
        </message>
        <message>
            <source>this window stood still</source>
            <translation type="unfinished">cette fenêtre était figée</translation>
        </message>
        <message>
            <source>it calms the needle</source>
            <translation type="unfinished">il calme l’aiguille</translation>
        </message>
        <message>
            <source>it answers late</source>
            <translation type="unfinished">il répond tard</translation>
        </message>
        <message>
            <source>the depth is not certain</source>
            <translation type="unfinished">la profondeur n’est pas certaine</translation>
        </message>
        <message>
            <source>Robot ready, the computer is busy</source>
            <translation type="unfinished">Robot prêt, l’ordinateur est occupé</translation>
        </message>
        <message>
            <source>acts: the force is weakened or damped</source>
            <translation type="unfinished">agit : la force est affaiblie ou amortie</translation>
        </message>
        <message>
            <source>at rest</source>
            <translation type="unfinished">au repos</translation>
        </message>
        <message>
            <source>Energy guard: {words}</source>
            <translation type="unfinished">Garde d’énergie : {words}</translation>
        </message>
        <message>
            <source>not recording</source>
            <translation type="unfinished">n’enregistre pas</translation>
        </message>
        <message>
            <source>recording</source>
            <translation type="unfinished">enregistre</translation>
        </message>
        <message>
            <source>{lost} samples lost</source>
            <translation type="unfinished">échantillons perdus : {lost}</translation>
        </message>
        <message>
            <source>failed</source>
            <translation type="unfinished">en échec</translation>
        </message>
        <message>
            <source>Recorder</source>
            <translation type="unfinished">Enregistreur</translation>
        </message>
        <message>
            <source>Every attempt is written to disk, flushed each second. If samples are lost, the disk is too slow or full: free some space.</source>
            <translation type="unfinished">Chaque essai est écrit sur le disque, vidé chaque seconde. Si des échantillons sont perdus, le disque est trop lent ou plein : libérez de l’espace.</translation>
        </message>
        <message>
            <source>never</source>
            <translation type="unfinished">jamais</translation>
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
            <translation type="unfinished">Prêt</translation>
        </message>
        <message>
            <source>Withdrawing</source>
            <translation type="unfinished">Retrait</translation>
        </message>
        <message>
            <source>Aligning</source>
            <translation type="unfinished">Alignement</translation>
        </message>
        <message>
            <source>Inserting</source>
            <translation type="unfinished">Ponction</translation>
        </message>
        <message>
            <source>Holding</source>
            <translation type="unfinished">Maintien</translation>
        </message>
        <message>
            <source>Paused</source>
            <translation type="unfinished">En pause</translation>
        </message>
        <message>
            <source>Ended</source>
            <translation type="unfinished">Terminé</translation>
        </message>
        <message>
            <source>Aborted</source>
            <translation type="unfinished">Abandonné</translation>
        </message>
        <message>
            <source>Unfinished</source>
            <translation type="unfinished">Inachevé</translation>
        </message>
        <message>
            <source>Broken</source>
            <translation type="unfinished">Endommagé</translation>
        </message>
        <message>
            <source>No attempt</source>
            <translation type="unfinished">Pas d’essai</translation>
        </message>
        <message>
            <source>Under way</source>
            <translation type="unfinished">En cours</translation>
        </message>
        <message>
            <source>Scans</source>
            <translation type="unfinished">Scans</translation>
        </message>
        <message>
            <source>Live pictures (Ctrl+T)</source>
            <translation type="unfinished">Images en direct (Ctrl+T)</translation>
        </message>
        <message>
            <source>All panels (Ctrl+B)</source>
            <translation type="unfinished">Tous les panneaux (Ctrl+B)</translation>
        </message>
        <message>
            <source>Pull out</source>
            <translation type="unfinished">Retirez</translation>
        </message>
        <message>
            <source>the patient's left</source>
            <translation type="unfinished">la gauche du patient</translation>
        </message>
        <message>
            <source>the patient's right</source>
            <translation type="unfinished">la droite du patient</translation>
        </message>
        <message>
            <source>the front</source>
            <translation type="unfinished">l’avant</translation>
        </message>
        <message>
            <source>the back</source>
            <translation type="unfinished">l’arrière</translation>
        </message>
        <message>
            <source>the head</source>
            <translation type="unfinished">la tête</translation>
        </message>
        <message>
            <source>the feet</source>
            <translation type="unfinished">les pieds</translation>
        </message>
        <message>
            <source> (wheel away from you)</source>
            <translation type="unfinished"> (molette vers l’avant)</translation>
        </message>
        <message>
            <source> (wheel towards you)</source>
            <translation type="unfinished"> (molette vers vous)</translation>
        </message>
        <message>
            <source> and </source>
            <translation type="unfinished"> et </translation>
        </message>
        <message>
            <source>Press F5 to start the attempt</source>
            <translation type="unfinished">Appuyez sur F5 pour démarrer l’essai</translation>
        </message>
        <message>
            <source>Aim {mm} mm further towards {sides}</source>
            <translation type="unfinished">Visez {mm} mm de plus vers {sides}</translation>
        </message>
        <message>
            <source>Tilt the hub towards {sides}: {mm} mm off the target</source>
            <translation type="unfinished">Inclinez l’embase vers {sides} : {mm} mm à côté de la cible</translation>
        </message>
        <message>
            <source>One moment: the needle goes to its start</source>
            <translation type="unfinished">Un instant : l’aiguille va à son point de départ</translation>
        </message>
        <message>
            <source>Pull the needle out of the skin</source>
            <translation type="unfinished">Retirez l’aiguille de la peau</translation>
        </message>
        <message>
            <source>Ready: the clock starts when you move</source>
            <translation type="unfinished">Prêt : le chrono part dès que vous bougez</translation>
        </message>
        <message>
            <source>Let both cameras see the marker</source>
            <translation type="unfinished">Faites voir le marqueur aux deux caméras</translation>
        </message>
        <message>
            <source>Push by the scans: S takes one, Enter ends the attempt</source>
            <translation type="unfinished">Avancez selon les scans : S en prend un, Entrée termine l’essai</translation>
        </message>
        <message>
            <source>Steer by the CT: S takes a scan, Enter ends the attempt</source>
            <translation type="unfinished">Guidez-vous par le CT : S prend un scan, Entrée termine l’essai</translation>
        </message>
        <message>
            <source>Push the needle in{how}</source>
            <translation type="unfinished">Avancez l’aiguille{how}</translation>
        </message>
        <message>
            <source>Push slowly{how}: the cameras do not see the depth</source>
            <translation type="unfinished">Avancez lentement{how} : les caméras ne voient pas la profondeur</translation>
        </message>
        <message>
            <source>The tip stands on bone: do not push, pull back{how}</source>
            <translation type="unfinished">La pointe bute sur l’os : n’avancez pas, retirez{how}</translation>
        </message>
        <message>
            <source>Push {mm} mm deeper{how}</source>
            <translation type="unfinished">Avancez de {mm} mm{how}</translation>
        </message>
        <message>
            <source>Pull back {mm} mm{how}</source>
            <translation type="unfinished">Retirez de {mm} mm{how}</translation>
        </message>
        <message>
            <source>Hold still</source>
            <translation type="unfinished">Restez immobile</translation>
        </message>
        <message>
            <source>Bring the tip to the target</source>
            <translation type="unfinished">Amenez la pointe à la cible</translation>
        </message>
        <message>
            <source>Stay on the target</source>
            <translation type="unfinished">Restez sur la cible</translation>
        </message>
        <message>
            <source>Press Enter: the tip is at the target</source>
            <translation type="unfinished">Appuyez sur Entrée : la pointe est à la cible</translation>
        </message>
        <message>
            <source>Push deeper{how}</source>
            <translation type="unfinished">Avancez encore{how}</translation>
        </message>
        <message>
            <source>Pull back{how}</source>
            <translation type="unfinished">Retirez un peu{how}</translation>
        </message>
        <message>
            <source>Aim further towards {sides}</source>
            <translation type="unfinished">Visez plus vers {sides}</translation>
        </message>
        <message>
            <source>Tilt the hub towards {sides}</source>
            <translation type="unfinished">Inclinez l’embase vers {sides}</translation>
        </message>
        <message>
            <source>Paused: the window was busy; it goes on by itself.</source>
            <translation type="unfinished">En pause : la fenêtre était occupée ; l’essai reprend de lui-même.</translation>
        </message>
        <message>
            <source>Paused: the needle swings in the simulated hand; it goes on by itself.</source>
            <translation type="unfinished">En pause : l’aiguille oscille dans la main simulée ; l’essai reprend de lui-même.</translation>
        </message>
        <message>
            <source>Paused: this computer is too busy. Close other programs; it goes on by itself.</source>
            <translation type="unfinished">En pause : cet ordinateur est trop occupé. Fermez d’autres programmes ; l’essai reprend de lui-même.</translation>
        </message>
        <message>
            <source>One moment: the robot is starting</source>
            <translation type="unfinished">Un instant : le robot démarre</translation>
        </message>
        <message>
            <source>✔ All {n} targets are touched: press Enter</source>
            <translation type="unfinished">✔ Toutes les cibles sont touchées ({n}) : appuyez sur Entrée</translation>
        </message>
        <message>
            <source>Stay on target {n} of {of}</source>
            <translation type="unfinished">Restez sur la cible {n} sur {of}</translation>
        </message>
        <message>
            <source>tip {mm} mm towards {sides} (hand the other way)</source>
            <translation type="unfinished">pointe de {mm} mm vers {sides} (main dans l’autre sens)</translation>
        </message>
        <message>
            <source>push {mm} mm</source>
            <translation type="unfinished">avancez de {mm} mm</translation>
        </message>
        <message>
            <source>pull {mm} mm</source>
            <translation type="unfinished">retirez de {mm} mm</translation>
        </message>
        <message>
            <source>a little nearer</source>
            <translation type="unfinished">un peu plus près</translation>
        </message>
        <message>
            <source>Target {n} of {of}: {way}</source>
            <translation type="unfinished">Cible {n} sur {of} : {way}</translation>
        </message>
        <message>
            <source>Held, {s:.0f} s left: </source>
            <translation type="unfinished">Apnée, encore {s:.0f} s : </translation>
        </message>
        <message>
            <source>The patient breathes freely (A releases, A asks again): {step}</source>
            <translation type="unfinished">Le patient respire librement (A relâche, encore A redemande) : {step}</translation>
        </message>
        <message>
            <source>He breathes by himself: {step}</source>
            <translation type="unfinished">Il respire de lui-même : {step}</translation>
        </message>
        <message>
            <source>Wait: he breathes out and holds</source>
            <translation type="unfinished">Attendez : il expire et bloque</translation>
        </message>
        <message>
            <source>Have the breath held (A): {step}</source>
            <translation type="unfinished">Demandez l’apnée (A) : {step}</translation>
        </message>
        <message>
            <source>Next step</source>
            <translation type="unfinished">Étape suivante</translation>
        </message>
        <message>
            <source>✔ Target {n} of {of} touched</source>
            <translation type="unfinished">✔ Cible {n} sur {of} touchée</translation>
        </message>
        <message>
            <source>The demonstration begins</source>
            <translation type="unfinished">La démonstration commence</translation>
        </message>
        <message>
            <source>Mask</source>
            <translation type="unfinished">Masque</translation>
        </message>
        <message>
            <source>Pixels that count as the marker's colour</source>
            <translation type="unfinished">Pixels comptés comme couleur du marqueur</translation>
        </message>
        <message>
            <source>Lines</source>
            <translation type="unfinished">Lignes</translation>
        </message>
        <message>
            <source>Where the marker may lie by what the other camera shows; it should pass through the marker</source>
            <translation type="unfinished">Où peut être le marqueur d’après l’autre caméra ; elle devrait passer par le marqueur</translation>
        </message>
        <message>
            <source>Region</source>
            <translation type="unfinished">Zone</translation>
        </message>
        <message>
            <source>Where the marker is looked for in the next picture</source>
            <translation type="unfinished">Où le marqueur est cherché dans l’image suivante</translation>
        </message>
        <message>
            <source>Zoom</source>
            <translation type="unfinished">Zoom</translation>
        </message>
        <message>
            <source>The marker's surroundings, enlarged</source>
            <translation type="unfinished">Les environs du marqueur, agrandis</translation>
        </message>
        <message>
            <source>Learn</source>
            <translation type="unfinished">Apprendre</translation>
        </message>
        <message>
            <source>Learn the marker's colour: press, then click on the marker in a picture</source>
            <translation type="unfinished">Apprendre la couleur du marqueur : appuyez, puis cliquez sur le marqueur dans une image</translation>
        </message>
        <message>
            <source>± {mm:.2f} mm</source>
            <translation type="unfinished">± {mm:.2f} mm</translation>
        </message>
        <message>
            <source>{size} + calibration (not known)</source>
            <translation type="unfinished">{size} + étalonnage (inconnu)</translation>
        </message>
        <message>
            <source>From the pictures alone: the calibration was imported, so its own uncertainty is unknown. The true radius is larger; calibrate with pictures of a board to learn it</source>
            <translation type="unfinished">D’après les seules images : l’étalonnage a été importé, sa propre incertitude est inconnue. Le vrai rayon est plus grand ; étalonnez avec des images d’une mire pour le connaître</translation>
        </message>
        <message>
            <source>{rate:.0f} pairs/s</source>
            <translation type="unfinished">{rate:.0f} paires/s</translation>
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
            <translation type="unfinished">De combien les deux images se contredisent ; au-dessus de 1 px, vérifiez l’étalonnage. Ce n’est pas une précision : une échelle fausse le laisse petit</translation>
        </message>
        <message>
            <source>Tip, 95 %</source>
            <translation type="unfinished">Pointe, 95 %</translation>
        </message>
        <message>
            <source>Radius round the tip that holds the true one with 95 %, by pictures and calibration</source>
            <translation type="unfinished">Rayon autour de la pointe qui contient la vraie à 95 %, d’après images et étalonnage</translation>
        </message>
        <message>
            <source>Rate</source>
            <translation type="unfinished">Cadence</translation>
        </message>
        <message>
            <source>Pairs of pictures a second</source>
            <translation type="unfinished">Paires d’images par seconde</translation>
        </message>
        <message>
            <source>Valid</source>
            <translation type="unfinished">Valides</translation>
        </message>
        <message>
            <source>Share of pairs in which both cameras saw the marker</source>
            <translation type="unfinished">Part des paires où les deux caméras ont vu le marqueur</translation>
        </message>
        <message>
            <source>From capture to the needle's place, median</source>
            <translation type="unfinished">De la prise de vue à la position de l’aiguille, médiane</translation>
        </message>
        <message>
            <source>Skew</source>
            <translation type="unfinished">Décalage</translation>
        </message>
        <message>
            <source>Capture of the right picture after the left one; it is made up for</source>
            <translation type="unfinished">Prise de l’image droite après la gauche ; c’est compensé</translation>
        </message>
        <message>
            <source>Only the instructor does that: change the role at the top right.</source>
            <translation type="unfinished">Seul le formateur peut le faire : changez de rôle en haut à droite.</translation>
        </message>
        <message>
            <source>(erased)</source>
            <translation type="unfinished">(effacé)</translation>
        </message>
        <message>
            <source>it is an assessment of the course {course}. Sign in as a student who takes it (Sessions ▸ Sign in as a student…), or as the instructor (role, at the top right)</source>
            <translation type="unfinished">c’est une évaluation du cours {course}. Connectez-vous comme un étudiant qui la passe (Séances ▸ Se connecter comme étudiant…), ou comme formateur (rôle, en haut à droite)</translation>
        </message>
        <message>
            <source>{x}   {y}   {z} mm</source>
            <translation type="unfinished">{x}   {y}   {z} mm</translation>
        </message>
        <message>
            <source>is empty: type something</source>
            <translation type="unfinished">est vide : saisissez quelque chose</translation>
        </message>
        <message>
            <source>is too long: at most {n} characters</source>
            <translation type="unfinished">est trop long : {n} caractères au plus</translation>
        </message>
        <message>
            <source>{value} cannot be used: small letters, digits and single hyphens, such as autumn-2026</source>
            <translation type="unfinished">{value} n’est pas utilisable : minuscules, chiffres et traits d’union simples, par exemple autumn-2026</translation>
        </message>
        <message>
            <source>is empty: small letters, digits and hyphens, such as autumn-2026</source>
            <translation type="unfinished">est vide : minuscules, chiffres et traits d’union, par exemple autumn-2026</translation>
        </message>
        <message>
            <source>{value} is no number: type one, such as 2.5</source>
            <translation type="unfinished">{value} n’est pas un nombre : saisissez-en un, par exemple 2.5</translation>
        </message>
        <message>
            <source>{value} is no whole number: type one, such as 2</source>
            <translation type="unfinished">{value} n’est pas un nombre entier : saisissez-en un, par exemple 2</translation>
        </message>
        <message>
            <source>{value} is no day: write year-month-day, such as 2026-11-30</source>
            <translation type="unfinished">{value} n’est pas une date : écrivez année-mois-jour, par exemple 2026-11-30</translation>
        </message>
        <message>
            <source>{value} is too small: at least {n}</source>
            <translation type="unfinished">{value} est trop petit : au moins {n}</translation>
        </message>
        <message>
            <source>{value} is too large: at most {n}</source>
            <translation type="unfinished">{value} est trop grand : au plus {n}</translation>
        </message>
        <message>
            <source>{value} is too small: more than {n}</source>
            <translation type="unfinished">{value} est trop petit : plus que {n}</translation>
        </message>
        <message>
            <source>{value} is too large: less than {n}</source>
            <translation type="unfinished">{value} est trop grand : moins que {n}</translation>
        </message>
        <message>
            <source>{value} cannot be used: {n}</source>
            <translation type="unfinished">{value} n’est pas utilisable : {n}</translation>
        </message>
        <message>
            <source>is missing: fill it in</source>
            <translation type="unfinished">manque : remplissez-le</translation>
        </message>
        <message>
            <source>row {n}</source>
            <translation type="unfinished">ligne {n}</translation>
        </message>
        <message>
            <source>none yet</source>
            <translation type="unfinished">rien encore</translation>
        </message>
        <message>
            <source>Cancelling…</source>
            <translation type="unfinished">Annulation…</translation>
        </message>
        <message>
            <source>{work} (and {count} more)</source>
            <translation type="unfinished">{work} (et {count} de plus)</translation>
        </message>
        <message>
            <source>Training only. Not a medical device; not for diagnosis or patient care.</source>
            <translation type="unfinished">Entraînement uniquement. Ce n’est pas un dispositif médical ; ni diagnostic, ni soin des patients.</translation>
        </message>
        <message>
            <source>Next</source>
            <translation type="unfinished">Suivant</translation>
        </message>
        <message>
            <source>Close</source>
            <translation type="unfinished">Fermer</translation>
        </message>
        <message>
            <source>Distance</source>
            <translation type="unfinished">Distance</translation>
        </message>
        <message>
            <source>Angle</source>
            <translation type="unfinished">Angle</translation>
        </message>
        <message>
            <source>HU probe</source>
            <translation type="unfinished">Sonde UH</translation>
        </message>
        <message>
            <source>Region (mean)</source>
            <translation type="unfinished">Région (moyenne)</translation>
        </message>
        <message>
            <source>Drag from point to point</source>
            <translation type="unfinished">Glissez d’un point à l’autre</translation>
        </message>
        <message>
            <source>Drag along one side to the vertex, then click the other side</source>
            <translation type="unfinished">Glissez le long d’un côté jusqu’au sommet, puis cliquez l’autre côté</translation>
        </message>
        <message>
            <source>Click: the value of that voxel</source>
            <translation type="unfinished">Clic : la valeur de ce voxel</translation>
        </message>
        <message>
            <source>Drag from corner to corner: mean ± deviation and area of the ellipse</source>
            <translation type="unfinished">Glissez d’un coin à l’autre : moyenne ± écart et aire de l’ellipse</translation>
        </message>
        <message>
            <source>Remove all</source>
            <translation type="unfinished">Tout supprimer</translation>
        </message>
        <message>
            <source>{kind}: type to name it</source>
            <translation type="unfinished">{kind} : saisissez son nom</translation>
        </message>
        <message>
            <source>Name</source>
            <translation type="unfinished">Nom</translation>
        </message>
        <message>
            <source>Measurements</source>
            <translation type="unfinished">Mesures</translation>
        </message>
        <message>
            <source>Double click on a value: the slices go there</source>
            <translation type="unfinished">Double clic sur une valeur : les coupes y vont</translation>
        </message>
        <message>
            <source>Measure</source>
            <translation type="unfinished">Mesurer</translation>
        </message>
        <message>
            <source>&amp;Measure</source>
            <translation type="unfinished">&amp;Mesurer</translation>
        </message>
        <message>
            <source>3D Slicer</source>
            <translation type="unfinished">3D Slicer</translation>
        </message>
        <message>
            <source>Export measurements</source>
            <translation type="unfinished">Exporter les mesures</translation>
        </message>
        <message>
            <source>List of measurements</source>
            <translation type="unfinished">Liste des mesures</translation>
        </message>
        <message>
            <source>Export measurements…</source>
            <translation type="unfinished">Exporter les mesures…</translation>
        </message>
        <message>
            <source>Retrieving from {name}</source>
            <translation type="unfinished">Récupération depuis {name}</translation>
        </message>
        <message>
            <source>From the PACS…</source>
            <translation type="unfinished">Depuis le PACS…</translation>
        </message>
        <message>
            <source>Configure PACS…</source>
            <translation type="unfinished">Configurer le PACS…</translation>
        </message>
        <message>
            <source>PACS</source>
            <translation type="unfinished">PACS</translation>
        </message>
        <message>
            <source>Search</source>
            <translation type="unfinished">Chercher</translation>
        </message>
        <message>
            <source>Configure…</source>
            <translation type="unfinished">Configurer…</translation>
        </message>
        <message>
            <source>Take into the library, de-identified</source>
            <translation type="unfinished">Ajouter à la bibliothèque, dé-identifié</translation>
        </message>
        <message>
            <source>Searching…</source>
            <translation type="unfinished">Recherche…</translation>
        </message>
        <message>
            <source>Searching {name}</source>
            <translation type="unfinished">Recherche dans {name}</translation>
        </message>
        <message>
            <source>Series</source>
            <translation type="unfinished">Série</translation>
        </message>
        <message>
            <source>* and ? stand for unknown characters</source>
            <translation type="unfinished">* et ? remplacent des caractères inconnus</translation>
        </message>
        <message>
            <source>FAMILY^GIVEN, with * and ?</source>
            <translation type="unfinished">NOM^PRÉNOM, avec * et ?</translation>
        </message>
        <message>
            <source>YYYYMMDD or YYYYMMDD-YYYYMMDD</source>
            <translation type="unfinished">AAAAMMJJ ou AAAAMMJJ-AAAAMMJJ</translation>
        </message>
        <message>
            <source>Patient ID</source>
            <translation type="unfinished">ID du patient</translation>
        </message>
        <message>
            <source>Date of the study</source>
            <translation type="unfinished">Date de l’examen</translation>
        </message>
        <message>
            <source>Names are shown here only; nothing of them is stored.</source>
            <translation type="unfinished">Les noms ne sont affichés qu’ici ; rien n’en est conservé.</translation>
        </message>
        <message>
            <source>No PACS is configured yet: press Configure…</source>
            <translation type="unfinished">Aucun PACS n’est encore configuré : appuyez sur Configurer…</translation>
        </message>
        <message>
            <source>{here} of {count} here, to be resumed</source>
            <translation type="unfinished">{here} sur {count} ici, à reprendre</translation>
        </message>
        <message>
            <source>C-GET: over the same connection</source>
            <translation type="unfinished">C-GET : par la même connexion</translation>
        </message>
        <message>
            <source>C-MOVE: it connects to us</source>
            <translation type="unfinished">C-MOVE : il se connecte à nous</translation>
        </message>
        <message>
            <source>Encrypted connection (TLS)</source>
            <translation type="unfinished">Connexion chiffrée (TLS)</translation>
        </message>
        <message>
            <source>Its certificate must name the host</source>
            <translation type="unfinished">Son certificat doit nommer l’hôte</translation>
        </message>
        <message>
            <source>what it is called here; no blanks</source>
            <translation type="unfinished">son nom ici ; sans espaces</translation>
        </message>
        <message>
            <source>Host</source>
            <translation type="unfinished">Hôte</translation>
        </message>
        <message>
            <source>name or address of the archive</source>
            <translation type="unfinished">nom ou adresse de l’archive</translation>
        </message>
        <message>
            <source>Port</source>
            <translation type="unfinished">Port</translation>
        </message>
        <message>
            <source>AE title</source>
            <translation type="unfinished">AE title</translation>
        </message>
        <message>
            <source>the archive's, at most 16 characters</source>
            <translation type="unfinished">celui de l’archive, 16 caractères au plus</translation>
        </message>
        <message>
            <source>Own AE title</source>
            <translation type="unfinished">AE title local</translation>
        </message>
        <message>
            <source>tell the archive's administrator</source>
            <translation type="unfinished">à communiquer à l’administrateur de l’archive</translation>
        </message>
        <message>
            <source>Retrieve by</source>
            <translation type="unfinished">Récupérer par</translation>
        </message>
        <message>
            <source>Own address</source>
            <translation type="unfinished">Adresse locale</translation>
        </message>
        <message>
            <source>empty: the one that leads to the archive</source>
            <translation type="unfinished">vide : celle qui mène à l’archive</translation>
        </message>
        <message>
            <source>Own port</source>
            <translation type="unfinished">Port local</translation>
        </message>
        <message>
            <source>Other senders</source>
            <translation type="unfinished">Autres expéditeurs</translation>
        </message>
        <message>
            <source>empty: pictures come from the host alone</source>
            <translation type="unfinished">vide : les images ne viennent que de l’hôte</translation>
        </message>
        <message>
            <source>Longest silence</source>
            <translation type="unfinished">Silence maximal</translation>
        </message>
        <message>
            <source>Authority</source>
            <translation type="unfinished">Autorité</translation>
        </message>
        <message>
            <source>PEM; empty: those that the system trusts</source>
            <translation type="unfinished">PEM ; vide : celles auxquelles le système fait confiance</translation>
        </message>
        <message>
            <source>Own certificate</source>
            <translation type="unfinished">Certificat local</translation>
        </message>
        <message>
            <source>PEM; where the archive asks for one</source>
            <translation type="unfinished">PEM ; si l’archive en demande un</translation>
        </message>
        <message>
            <source>Own key</source>
            <translation type="unfinished">Clé locale</translation>
        </message>
        <message>
            <source>PEM without a password</source>
            <translation type="unfinished">PEM sans mot de passe</translation>
        </message>
        <message>
            <source>Own address and port are where C-MOVE's pictures come; the port is open only while a retrieval lasts.</source>
            <translation type="unfinished">Les images de C-MOVE arrivent à l’adresse et au port locaux ; le port n’est ouvert que pendant une récupération.</translation>
        </message>
        <message>
            <source>Choose…</source>
            <translation type="unfinished">Choisir…</translation>
        </message>
        <message>
            <source>Choose a file</source>
            <translation type="unfinished">Choisir un fichier</translation>
        </message>
        <message>
            <source>PACS: configuration</source>
            <translation type="unfinished">PACS : configuration</translation>
        </message>
        <message>
            <source>Add</source>
            <translation type="unfinished">Ajouter</translation>
        </message>
        <message>
            <source>Test (C-ECHO)</source>
            <translation type="unfinished">Tester (C-ECHO)</translation>
        </message>
        <message>
            <source>Asking {name}…</source>
            <translation type="unfinished">Interrogation de {name}…</translation>
        </message>
        <message>
            <source>{name} answers in {time} ms</source>
            <translation type="unfinished">{name} répond en {time} ms</translation>
        </message>
        <message>
            <source>Cancelled</source>
            <translation type="unfinished">Annulé</translation>
        </message>
        <message>
            <source>Asking {name}</source>
            <translation type="unfinished">Interrogation de {name}</translation>
        </message>
        <message>
            <source>The name {name} is given twice</source>
            <translation type="unfinished">Le nom {name} est donné deux fois</translation>
        </message>
        <message>
            <source>It cannot be written: {why}</source>
            <translation type="unfinished">Écriture impossible : {why}</translation>
        </message>
        <message>
            <source>The changes are not saved. Save them first?</source>
            <translation type="unfinished">Les modifications ne sont pas enregistrées. Les enregistrer d’abord ?</translation>
        </message>
        <message>
            <source>Save replaces the file.</source>
            <translation type="unfinished">Enregistrer remplace le fichier.</translation>
        </message>
        <message>
            <source>Configured PACS</source>
            <translation type="unfinished">PACS configurés</translation>
        </message>
        <message>
            <source>without a name</source>
            <translation type="unfinished">sans nom</translation>
        </message>
        <message>
            <source>guessed from the pictures' size</source>
            <translation type="unfinished">estimé d’après la taille des images</translation>
        </message>
        <message>
            <source>a calibration's file…</source>
            <translation type="unfinished">un fichier d’étalonnage…</translation>
        </message>
        <message>
            <source>A guess is good for trying out. `acus calibrate mono --images FOLDER --out lens.yaml` measures the lens; of a calibrated pair of cameras either may be taken</source>
            <translation type="unfinished">Une estimation suffit pour essayer. `acus calibrate mono --images FOLDER --out lens.yaml` mesure l’objectif ; d’une paire de caméras étalonnée, l’une ou l’autre convient</translation>
        </message>
        <message>
            <source>Calibration of the webcam</source>
            <translation type="unfinished">Étalonnage de la webcam</translation>
        </message>
        <message>
            <source>Calibrations (*.yaml *.yml)</source>
            <translation type="unfinished">Étalonnages (*.yaml *.yml)</translation>
        </message>
        <message>
            <source>written to {file}: print it at 100 %, check the line of 100 mm, cut, fold, glue</source>
            <translation type="unfinished">écrit dans {file} : imprimez à 100 %, vérifiez la ligne de 100 mm, découpez, pliez, collez</translation>
        </message>
        <message>
            <source>Save the pen</source>
            <translation type="unfinished">Enregistrer le stylo</translation>
        </message>
        <message>
            <source>Cube: five faces, also seen from above. Ring: six faces round the shaft</source>
            <translation type="unfinished">Cube : cinq faces, visibles aussi d’en haut. Anneau : six faces autour de la tige</translation>
        </message>
        <message>
            <source>Edge of a face. Larger is more accurate, and heavier</source>
            <translation type="unfinished">Côté d’une face. Plus grand, c’est plus précis, mais plus lourd</translation>
        </message>
        <message>
            <source>Width and height of the webcam's pictures</source>
            <translation type="unfinished">Largeur et hauteur des images de la webcam</translation>
        </message>
        <message>
            <source>Paper of the printer</source>
            <translation type="unfinished">Papier de l’imprimante</translation>
        </message>
        <message>
            <source>The net of the pen and the sheet for the table, at true size</source>
            <translation type="unfinished">Le patron du stylo et la feuille pour la table, en vraie grandeur</translation>
        </message>
        <message>
            <source>&amp;Pen</source>
            <translation type="unfinished">St&amp;ylo</translation>
        </message>
        <message>
            <source>&amp;Webcam</source>
            <translation type="unfinished">&amp;Webcam</translation>
        </message>
        <message>
            <source>&amp;Lens</source>
            <translation type="unfinished">&amp;Objectif</translation>
        </message>
        <message>
            <source>Print</source>
            <translation type="unfinished">Imprimer</translation>
        </message>
        <message>
            <source>Pen and webcam: a needle without a robot</source>
            <translation type="unfinished">Stylo et webcam : une aiguille sans robot</translation>
        </message>
        <message>
            <source>&amp;Use the pen as needle</source>
            <translation type="unfinished">&amp;Prendre le stylo pour aiguille</translation>
        </message>
        <message>
            <source>Back to the &amp;robot</source>
            <translation type="unfinished">Retour au &amp;robot</translation>
        </message>
        <message>
            <source>&amp;Try again</source>
            <translation type="unfinished">Ré&amp;essayer</translation>
        </message>
        <message>
            <source>the webcam could not be opened</source>
            <translation type="unfinished">la webcam n’a pas pu être ouverte</translation>
        </message>
        <message>
            <source>stopped, nothing is changed</source>
            <translation type="unfinished">arrêté, rien n’est modifié</translation>
        </message>
        <message>
            <source>Measured tip</source>
            <translation type="unfinished">Pointe mesurée</translation>
        </message>
        <message>
            <source>Save the measured tip?</source>
            <translation type="unfinished">Enregistrer la pointe mesurée ?</translation>
        </message>
        <message>
            <source>The next attempts are made with the pen, without a robot</source>
            <translation type="unfinished">Les prochains essais se font avec le stylo, sans robot</translation>
        </message>
        <message>
            <source>The robot, or the simulated one, holds the needle again</source>
            <translation type="unfinished">Le robot, réel ou simulé, tient de nouveau l’aiguille</translation>
        </message>
        <message>
            <source>&amp;Use this pen</source>
            <translation type="unfinished">&amp;Utiliser ce stylo</translation>
        </message>
        <message>
            <source>Open the webcam again, for instance after plugging it in</source>
            <translation type="unfinished">Rouvrir la webcam, par exemple après l’avoir branchée</translation>
        </message>
        <message>
            <source>Which pen</source>
            <translation type="unfinished">Quel stylo</translation>
        </message>
        <message>
            <source>Its tip</source>
            <translation type="unfinished">Sa pointe</translation>
        </message>
        <message>
            <source>The pen is the needle now: {source}</source>
            <translation type="unfinished">Le stylo est maintenant l’aiguille : {source}</translation>
        </message>
        <message>
            <source>The pen is the needle now. Choose an exercise: it runs on the pen</source>
            <translation type="unfinished">Le stylo est maintenant l’aiguille. Choisissez un exercice : il se fait avec le stylo</translation>
        </message>
        <message>
            <source>The robot holds the needle</source>
            <translation type="unfinished">Le robot tient l’aiguille</translation>
        </message>
        <message>
            <source>Pen and webcam: set up, measure, print…</source>
            <translation type="unfinished">Stylo et webcam : installer, mesurer, imprimer…</translation>
        </message>
        <message>
            <source>A needle without a robot: docs/pen.md</source>
            <translation type="unfinished">Une aiguille sans robot : docs/pen.md</translation>
        </message>
        <message>
            <source>A pen before a webcam: {source}</source>
            <translation type="unfinished">Un stylo devant une webcam : {source}</translation>
        </message>
        <message>
            <source>A pen before a webcam: choose…</source>
            <translation type="unfinished">Un stylo devant une webcam : choisir…</translation>
        </message>
        <message>
            <source>Pen {name}</source>
            <translation type="unfinished">Stylo {name}</translation>
        </message>
        <message>
            <source>Print at 100 %, not “fit to page”: the line is 100 mm, a black square {side:.1f} mm; {how}.</source>
            <translation type="unfinished">Imprimez à 100 %, pas « ajuster à la page » : la ligne mesure 100 mm, un carré noir {side:.1f} mm ; {how}.</translation>
        </message>
        <message>
            <source>lay it on a box and punch the cross: the shaft goes through it</source>
            <translation type="unfinished">posez-la sur une boîte et percez la croix : la tige y passe</translation>
        </message>
        <message>
            <source>cut, fold along the lines and close it round two discs of cardboard, {across:.0f} mm from side to side; the shaft goes through their middles</source>
            <translation type="unfinished">découpez, pliez selon les lignes et refermez autour de deux disques de carton, {across:.0f} mm d’un côté à l’autre ; la tige passe par leurs centres</translation>
        </message>
        <message>
            <source>cut along the outside, fold along the lines, glue the tabs inside; the shaft goes through both crosses</source>
            <translation type="unfinished">découpez le contour, pliez selon les lignes, collez les languettes à l’intérieur ; la tige passe par les deux croix</translation>
        </message>
        <message>
            <source>Radius round the shown tip that holds the true one in 95 of 100 cases: noise, print, lens and the tip's own place are all in it</source>
            <translation type="unfinished">Rayon autour de la pointe affichée qui contient la vraie dans 95 cas sur 100 : bruit, impression, objectif et position de la pointe elle-même y sont compris</translation>
        </message>
        <message>
            <source>Seen from above, the webcam at the bottom. A sector fills when the pen has leant that way; the dot is how it leans now</source>
            <translation type="unfinished">Vu d’en haut, la webcam en bas. Un secteur se remplit quand le stylo s’est incliné de ce côté ; le point montre son inclinaison actuelle</translation>
        </message>
        <message>
            <source>away</source>
            <translation type="unfinished">au fond</translation>
        </message>
        <message>
            <source>webcam</source>
            <translation type="unfinished">webcam</translation>
        </message>
        <message>
            <source>&amp;Measure the tip</source>
            <translation type="unfinished">&amp;Mesurer la pointe</translation>
        </message>
        <message>
            <source>Compute now</source>
            <translation type="unfinished">Calculer</translation>
        </message>
        <message>
            <source>&amp;Save</source>
            <translation type="unfinished">&amp;Enregistrer</translation>
        </message>
        <message>
            <source>stopped: pen or webcam are others now</source>
            <translation type="unfinished">arrêté : le stylo ou la webcam a changé</translation>
        </message>
        <message>
            <source>{n} of {all} positions</source>
            <translation type="unfinished">Positions : {n} sur {all}</translation>
        </message>
        <message>
            <source>; still missing: {side}</source>
            <translation type="unfinished">; manque encore : {side}</translation>
        </message>
        <message>
            <source>; all sides are covered, go on rocking</source>
            <translation type="unfinished">; tous les côtés sont couverts, continuez à basculer</translation>
        </message>
        <message>
            <source>saved and in use</source>
            <translation type="unfinished">enregistrée et utilisée</translation>
        </message>
        <message>
            <source>the tip before is in use</source>
            <translation type="unfinished">la pointe précédente est utilisée</translation>
        </message>
        <message>
            <source>the drawing's tip is in use</source>
            <translation type="unfinished">la pointe du dessin est utilisée</translation>
        </message>
        <message>
            <source>&amp;Measure again</source>
            <translation type="unfinished">&amp;Mesurer encore</translation>
        </message>
        <message>
            <source>A simulated pen's tip is not saved: it would be mistaken for the real one's</source>
            <translation type="unfinished">La pointe d’un stylo simulé n’est pas enregistrée : on la prendrait pour celle du vrai</translation>
        </message>
        <message>
            <source>Keep this tip; it is used from now on</source>
            <translation type="unfinished">Garder cette pointe ; elle sert désormais</translation>
        </message>
        <message>
            <source>done; a simulated pen is practice only and is not kept</source>
            <translation type="unfinished">terminé ; un stylo simulé ne sert qu’à s’exercer et n’est pas gardé</translation>
        </message>
        <message>
            <source>measured, not saved yet</source>
            <translation type="unfinished">mesurée, pas encore enregistrée</translation>
        </message>
        <message>
            <source>Use the tip before this one; once more uses this one again</source>
            <translation type="unfinished">Utiliser la pointe précédente ; une fois de plus, et celle-ci sert de nouveau</translation>
        </message>
        <message>
            <source>Do not wait for all positions and sides</source>
            <translation type="unfinished">Ne pas attendre toutes les positions ni tous les côtés</translation>
        </message>
        <message>
            <source>Stand the tip in a dimple on the sheet, hold it there, and rock the pen slowly to every side, by 30°.</source>
            <translation type="unfinished">Posez la pointe dans un creux sur la feuille, maintenez-la et basculez lentement le stylo de tous les côtés, de 30°.</translation>
        </message>
        <message>
            <source>The needle is not seen: {why}</source>
            <translation type="unfinished">L’aiguille n’est pas visible : {why}</translation>
        </message>
        <message>
            <source>waiting for the first picture …</source>
            <translation type="unfinished">attente de la première image …</translation>
        </message>
        <message>
            <source>The needle's position is unknown: {why}</source>
            <translation type="unfinished">La position de l’aiguille est inconnue : {why}</translation>
        </message>
        <message>
            <source>The tip is known to ±N{NO-BREAK SPACE}{mm:.1f} mm (95 %), the direction to ±N{NO-BREAK SPACE}{deg:.1f}°</source>
            <translation type="unfinished">La pointe est connue à ±N{NO-BREAK SPACE}{mm:.1f} mm près (95 %), la direction à ±N{NO-BREAK SPACE}{deg:.1f}°</translation>
        </message>
        <message>
            <source>known exactly: the webcam is simulated</source>
            <translation type="unfinished">connu exactement : la webcam est simulée</translation>
        </message>
        <message>
            <source>the lens is {source}</source>
            <translation type="unfinished">l’objectif est {source}</translation>
        </message>
        <message>
            <source>the lens is calibrated</source>
            <translation type="unfinished">l’objectif est étalonné</translation>
        </message>
        <message>
            <source>the lens is guessed: `acus calibrate mono` measures it, then choose its file</source>
            <translation type="unfinished">l’objectif est estimé : `acus calibrate mono` le mesure, choisissez ensuite son fichier</translation>
        </message>
        <message>
            <source>the tip is measured</source>
            <translation type="unfinished">la pointe est mesurée</translation>
        </message>
        <message>
            <source>the tip is where the drawing has it: measure it</source>
            <translation type="unfinished">la pointe est là où le dessin la place : mesurez-la</translation>
        </message>
        <message>
            <source>tip known to {sd:.2f} mm (standard deviation, worst direction)</source>
            <translation type="unfinished">pointe connue à {sd:.2f} mm près (écart type, pire direction)</translation>
        </message>
        <message>
            <source>it stood still to {rms:.2f} mm in {n} positions, {out} left out</source>
            <translation type="unfinished">immobile à {rms:.2f} mm près ; positions : {n}, écartées : {out}</translation>
        </message>
        <message>
            <source>too few positions to hold any back</source>
            <translation type="unfinished">trop peu de positions pour en réserver</translation>
        </message>
        <message>
            <source>{n} positions held back: {rms:.2f} mm off (at most {worst:.1f} mm)</source>
            <translation type="unfinished">positions réservées : {n} ; écart {rms:.2f} mm (au plus {worst:.1f} mm)</translation>
        </message>
        <message>
            <source>direction of the shaft to {deg:.2f}°</source>
            <translation type="unfinished">direction de la tige à {deg:.2f}° près</translation>
        </message>
        <message>
            <source>{faces} of {all} faces of the {name} and {sheet} markers of the sheet are seen</source>
            <translation type="unfinished">visibles : {faces} des {all} faces de {name}, marqueurs de la feuille : {sheet}</translation>
        </message>
        <message>
            <source>; two faces tell more: turn a corner of the {name} to the webcam</source>
            <translation type="unfinished">; deux faces en disent plus : tournez un coin de {name} vers la webcam</translation>
        </message>
        <message>
            <source>show a whole face to the webcam; come nearer, give more light</source>
            <translation type="unfinished">montrez une face entière à la webcam ; approchez, ajoutez de la lumière</translation>
        </message>
        <message>
            <source>show the sheet too, with nothing lying on its markers</source>
            <translation type="unfinished">montrez aussi la feuille, sans rien sur ses marqueurs</translation>
        </message>
        <message>
            <source>the pen is held still enough</source>
            <translation type="unfinished">le stylo est tenu assez immobile</translation>
        </message>
        <message>
            <source>hold still: at {speed:.0f} mm/s the picture blurs</source>
            <translation type="unfinished">tenez-le immobile : à {speed:.0f} mm/s, l’image est floue</translation>
        </message>
        <message>
            <source>Progress, students and courses</source>
            <translation type="unfinished">Progrès, étudiants et cours</translation>
        </message>
        <message>
            <source>Sign in as a student…</source>
            <translation type="unfinished">Se connecter comme étudiant…</translation>
        </message>
        <message>
            <source>Sign in as the instructor…</source>
            <translation type="unfinished">Se connecter comme formateur…</translation>
        </message>
        <message>
            <source>Sign out</source>
            <translation type="unfinished">Se déconnecter</translation>
        </message>
        <message>
            <source>Back up everything…</source>
            <translation type="unfinished">Tout sauvegarder…</translation>
        </message>
        <message>
            <source>Pseudonym</source>
            <translation type="unfinished">Pseudonyme</translation>
        </message>
        <message>
            <source>PIN</source>
            <translation type="unfinished">Code PIN</translation>
        </message>
        <message>
            <source>Sign in</source>
            <translation type="unfinished">Se connecter</translation>
        </message>
        <message>
            <source>Password</source>
            <translation type="unfinished">Mot de passe</translation>
        </message>
        <message>
            <source>Sign in as the instructor</source>
            <translation type="unfinished">Se connecter comme formateur</translation>
        </message>
        <message>
            <source>No password is set yet: whoever is here may do everything. A password keeps students from people, courses, deleting and exports. It guards against curiosity, not against the owner of the disk.</source>
            <translation type="unfinished">Aucun mot de passe n’est encore défini : quiconque est ici peut tout faire. Un mot de passe tient les étudiants à l’écart des personnes, des cours, des suppressions et des exports. Il protège de la curiosité, pas du propriétaire du disque.</translation>
        </message>
        <message>
            <source>the two passwords are not the same: type them again</source>
            <translation type="unfinished">les deux mots de passe diffèrent : saisissez-les à nouveau</translation>
        </message>
        <message>
            <source>Recovery key</source>
            <translation type="unfinished">Clé de récupération</translation>
        </message>
        <message>
            <source>Write this down and lock it away: it sets a new password, and opens the station's key in a backup. It is not stored anywhere.</source>
            <translation type="unfinished">Notez-la et mettez-la sous clé : elle permet de définir un nouveau mot de passe et ouvre la clé du poste dans une sauvegarde. Elle n’est enregistrée nulle part.</translation>
        </message>
        <message>
            <source>New password</source>
            <translation type="unfinished">Nouveau mot de passe</translation>
        </message>
        <message>
            <source>Set the instructor's password</source>
            <translation type="unfinished">Définir le mot de passe du formateur</translation>
        </message>
        <message>
            <source>Sign in first: as a student, or as the instructor.</source>
            <translation type="unfinished">Connectez-vous d’abord : comme étudiant ou comme formateur.</translation>
        </message>
        <message>
            <source>Reading the attempts</source>
            <translation type="unfinished">Lecture des essais</translation>
        </message>
        <message>
            <source>PIN (empty: drawn)</source>
            <translation type="unfinished">Code PIN (vide : tiré au sort)</translation>
        </message>
        <message>
            <source>Groups</source>
            <translation type="unfinished">Groupes</translation>
        </message>
        <message>
            <source>The pseudonym is what screens show; the name is kept apart from all records.</source>
            <translation type="unfinished">Les écrans montrent le pseudonyme ; le nom reste séparé de tous les enregistrements.</translation>
        </message>
        <message>
            <source>Hand this out; it is not stored anywhere.</source>
            <translation type="unfinished">Remettez-le à l’étudiant ; il n’est enregistré nulle part.</translation>
        </message>
        <message>
            <source>Add a student</source>
            <translation type="unfinished">Ajouter un étudiant</translation>
        </message>
        <message>
            <source>CSV (*.csv *.txt)</source>
            <translation type="unfinished">CSV (*.csv *.txt)</translation>
        </message>
        <message>
            <source>Roster</source>
            <translation type="unfinished">Liste</translation>
        </message>
        <message>
            <source>Taking the roster</source>
            <translation type="unfinished">Prise en compte de la liste</translation>
        </message>
        <message>
            <source>Nothing was imported. Correct these rows and import the roster again:</source>
            <translation type="unfinished">Rien n’a été importé. Corrigez ces lignes et importez à nouveau la liste :</translation>
        </message>
        <message>
            <source>1 student added, {m} updated</source>
            <translation type="unfinished">Étudiants ajoutés : 1, mis à jour : {m}</translation>
        </message>
        <message>
            <source>{n} students added, {m} updated</source>
            <translation type="unfinished">Étudiants ajoutés : {n}, mis à jour : {m}</translation>
        </message>
        <message>
            <source>Hand these out; they are kept nowhere.</source>
            <translation type="unfinished">Distribuez-les ; ils ne sont conservés nulle part.</translation>
        </message>
        <message>
            <source>PINs</source>
            <translation type="unfinished">Codes PIN</translation>
        </message>
        <message>
            <source>Erase</source>
            <translation type="unfinished">Effacer</translation>
        </message>
        <message>
            <source>Erase {name} for good?</source>
            <translation type="unfinished">Effacer {name} définitivement ?</translation>
        </message>
        <message>
            <source>Name, PIN, groups and comments go, and no backup brings them back. The records of attempts hold a random key only: they can stay as nobody's, or go too.</source>
            <translation type="unfinished">Nom, code PIN, groupes et commentaires disparaissent, et aucune sauvegarde ne les restitue. Les enregistrements des essais ne portent qu’une clé aléatoire : ils peuvent rester sans propriétaire, ou disparaître aussi.</translation>
        </message>
        <message>
            <source>Erase, keep the records</source>
            <translation type="unfinished">Effacer, garder les enregistrements</translation>
        </message>
        <message>
            <source>Erase with all records</source>
            <translation type="unfinished">Effacer avec les enregistrements</translation>
        </message>
        <message>
            <source>{name} was erased; records deleted: {n}, kept as nobody's: {m}</source>
            <translation type="unfinished">{name} a été effacé ; enregistrements supprimés : {n}, gardés sans propriétaire : {m}</translation>
        </message>
        <message>
            <source>Erasing</source>
            <translation type="unfinished">Effacement</translation>
        </message>
        <message>
            <source>{id} is already in use: choose another file name</source>
            <translation type="unfinished">{id} est déjà utilisé : choisissez un autre nom de fichier</translation>
        </message>
        <message>
            <source>{title} cannot be begun: {why}.</source>
            <translation type="unfinished">Impossible de commencer {title} : {why}.</translation>
        </message>
        <message>
            <source>Release {n} results of {title}?</source>
            <translation type="unfinished">Publier {n} résultats de {title} ?</translation>
        </message>
        <message>
            <source>Release 1 result of {title}?</source>
            <translation type="unfinished">Publier 1 résultat de {title} ?</translation>
        </message>
        <message>
            <source>Release results</source>
            <translation type="unfinished">Publier les résultats</translation>
        </message>
        <message>
            <source>Their students see score, replay and your comments then. Each can be held back.</source>
            <translation type="unfinished">Les étudiants voient alors la note, la relecture et vos commentaires. Chaque résultat peut être retenu.</translation>
        </message>
        <message>
            <source>Release</source>
            <translation type="unfinished">Publier</translation>
        </message>
        <message>
            <source>{n} results released</source>
            <translation type="unfinished">{n} résultats publiés</translation>
        </message>
        <message>
            <source>1 result released</source>
            <translation type="unfinished">1 résultat publié</translation>
        </message>
        <message>
            <source>Choose a student on the board first: click on the row.</source>
            <translation type="unfinished">Choisissez d’abord un étudiant dans le tableau : cliquez sur la ligne.</translation>
        </message>
        <message>
            <source>Export results</source>
            <translation type="unfinished">Exporter les résultats</translation>
        </message>
        <message>
            <source>Writing the results</source>
            <translation type="unfinished">Écriture des résultats</translation>
        </message>
        <message>
            <source>Backup of Acus (*.acusbackup)</source>
            <translation type="unfinished">Sauvegarde d’Acus (*.acusbackup)</translation>
        </message>
        <message>
            <source>Back up everything</source>
            <translation type="unfinished">Tout sauvegarder</translation>
        </message>
        <message>
            <source>{n} records saved in {name}</source>
            <translation type="unfinished">Enregistrements sauvegardés dans {name} : {n}</translation>
        </message>
        <message>
            <source>Not in it: {what}</source>
            <translation type="unfinished">Non compris : {what}</translation>
        </message>
        <message>
            <source>Backing up</source>
            <translation type="unfinished">Sauvegarde</translation>
        </message>
        <message>
            <source>It cannot be begun: {why}.</source>
            <translation type="unfinished">Impossible de commencer : {why}.</translation>
        </message>
        <message>
            <source>Progress and courses</source>
            <translation type="unfinished">Progrès et cours</translation>
        </message>
        <message>
            <source> · {n} void</source>
            <translation type="unfinished"> · nuls : {n}</translation>
        </message>
        <message>
            <source>– ({n} not counted)</source>
            <translation type="unfinished">– (non comptés : {n})</translation>
        </message>
        <message>
            <source>{passed}best {best:.0f}, last {last:.0f}{arrow} · {since}{void}   </source>
            <translation type="unfinished">{passed}meilleur {best:.0f}, dernier {last:.0f}{arrow} · {since}{void}   </translation>
        </message>
        <message>
            <source>just now</source>
            <translation type="unfinished">à l’instant</translation>
        </message>
        <message>
            <source>{n} h ago</source>
            <translation type="unfinished">il y a {n} h</translation>
        </message>
        <message>
            <source>{n} d ago</source>
            <translation type="unfinished">il y a {n} j</translation>
        </message>
        <message>
            <source>{n} attempts count</source>
            <translation type="unfinished">{n} essais comptent</translation>
        </message>
        <message>
            <source>1 attempt counts</source>
            <translation type="unfinished">1 essai compte</translation>
        </message>
        <message>
            <source>trend {trend:+.1f} points a time</source>
            <translation type="unfinished">tendance {trend:+.1f} points par essai</translation>
        </message>
        <message>
            <source>{n} not counted: {why}</source>
            <translation type="unfinished">non comptés : {n} ; {why}</translation>
        </message>
        <message>
            <source>Progress</source>
            <translation type="unfinished">Progrès</translation>
        </message>
        <message>
            <source>Curve</source>
            <translation type="unfinished">Courbe</translation>
        </message>
        <message>
            <source>Points over the attempts (Enter)</source>
            <translation type="unfinished">Points au fil des essais (Entrée)</translation>
        </message>
        <message>
            <source>Attempts…</source>
            <translation type="unfinished">Essais…</translation>
        </message>
        <message>
            <source>List them: debrief, replay, remarks (Ctrl+Enter)</source>
            <translation type="unfinished">Les lister : débriefing, relecture, remarques (Ctrl+Entrée)</translation>
        </message>
        <message>
            <source>Form of the results</source>
            <translation type="unfinished">Forme des résultats</translation>
        </message>
        <message>
            <source>Table, a row for each metric (CSV)</source>
            <translation type="unfinished">Tableau, une ligne par indicateur (CSV)</translation>
        </message>
        <message>
            <source>Table, a row for each student (CSV)</source>
            <translation type="unfinished">Tableau, une ligne par étudiant (CSV)</translation>
        </message>
        <message>
            <source>Gradebook for Moodle (CSV)</source>
            <translation type="unfinished">Carnet de notes pour Moodle (CSV)</translation>
        </message>
        <message>
            <source>Everything (JSON)</source>
            <translation type="unfinished">Tout (JSON)</translation>
        </message>
        <message>
            <source>Report of the group (PDF)</source>
            <translation type="unfinished">Rapport du groupe (PDF)</translation>
        </message>
        <message>
            <source>Report of the student chosen (PDF)</source>
            <translation type="unfinished">Rapport de l’étudiant choisi (PDF)</translation>
        </message>
        <message>
            <source>Decimal comma</source>
            <translation type="unfinished">Virgule décimale</translation>
        </message>
        <message>
            <source>Semicolons and decimal commas: as Excel opens them where the comma is the sign</source>
            <translation type="unfinished">Points-virgules et virgules décimales : comme Excel les ouvre là où la virgule est d’usage</translation>
        </message>
        <message>
            <source>Group</source>
            <translation type="unfinished">Groupe</translation>
        </message>
        <message>
            <source>Course</source>
            <translation type="unfinished">Cours</translation>
        </message>
        <message>
            <source>All exercises</source>
            <translation type="unfinished">Tous les exercices</translation>
        </message>
        <message>
            <source>Everybody</source>
            <translation type="unfinished">Tous</translation>
        </message>
        <message>
            <source>Nobody yet: add students, or a roster, on the next tab.</source>
            <translation type="unfinished">Personne encore : ajoutez des étudiants, ou une liste, dans l’onglet suivant.</translation>
        </message>
        <message>
            <source>Nothing yet: attempts of students who signed in will appear here.</source>
            <translation type="unfinished">Rien encore : les essais des étudiants connectés apparaîtront ici.</translation>
        </message>
        <message>
            <source>Only attempts that may be compared; none of a script or an emulated robot. Double-click a cell for its curve, a student for all attempts.</source>
            <translation type="unfinished">Seulement les essais comparables ; aucun d’un script ou d’un robot émulé. Double-cliquez sur une case pour sa courbe, sur un étudiant pour tous ses essais.</translation>
        </message>
        <message>
            <source>Students</source>
            <translation type="unfinished">Étudiants</translation>
        </message>
        <message>
            <source>Add…</source>
            <translation type="unfinished">Ajouter…</translation>
        </message>
        <message>
            <source>Roster from CSV…</source>
            <translation type="unfinished">Liste depuis un CSV…</translation>
        </message>
        <message>
            <source>New PIN</source>
            <translation type="unfinished">Nouveau PIN</translation>
        </message>
        <message>
            <source>Erase…</source>
            <translation type="unfinished">Effacer…</translation>
        </message>
        <message>
            <source>No students yet. A roster is CSV: pseudonym, name, pin, group.</source>
            <translation type="unfinished">Pas encore d’étudiants. Une liste est un CSV : pseudonym, name, pin, group.</translation>
        </message>
        <message>
            <source>Courses</source>
            <translation type="unfinished">Cours</translation>
        </message>
        <message>
            <source>Dates</source>
            <translation type="unfinished">Dates</translation>
        </message>
        <message>
            <source>Now</source>
            <translation type="unfinished">En cours</translation>
        </message>
        <message>
            <source>Begin</source>
            <translation type="unfinished">Commencer</translation>
        </message>
        <message>
            <source>New course…</source>
            <translation type="unfinished">Nouveau cours…</translation>
        </message>
        <message>
            <source>Edit…</source>
            <translation type="unfinished">Modifier…</translation>
        </message>
        <message>
            <source>Release results…</source>
            <translation type="unfinished">Publier les résultats…</translation>
        </message>
        <message>
            <source>Let students see the results of this course that wait</source>
            <translation type="unfinished">Montrer aux étudiants les résultats de ce cours qui attendent</translation>
        </message>
        <message>
            <source>everybody</source>
            <translation type="unfinished">tous</translation>
        </message>
        <message>
            <source>, in order</source>
            <translation type="unfinished">, dans l’ordre</translation>
        </message>
        <message>
            <source>{n} results wait for their release</source>
            <translation type="unfinished">Résultats en attente de publication : {n}</translation>
        </message>
        <message>
            <source>no exercises yet</source>
            <translation type="unfinished">pas encore d’exercices</translation>
        </message>
        <message>
            <source>No courses yet: a course is exercises in order, for groups, with dates.</source>
            <translation type="unfinished">Pas encore de cours : un cours est une suite d’exercices, pour des groupes, avec des dates.</translation>
        </message>
        <message>
            <source>You take no course. Exercises are on the start page.</source>
            <translation type="unfinished">Vous ne suivez aucun cours. Les exercices sont sur la page d’accueil.</translation>
        </message>
        <message>
            <source>Begin: {title}</source>
            <translation type="unfinished">Commencer : {title}</translation>
        </message>
        <message>
            <source>nothing is left to be begun</source>
            <translation type="unfinished">il ne reste rien à commencer</translation>
        </message>
        <message>
            <source>Briefing first, then the attempt (Enter)</source>
            <translation type="unfinished">D’abord les consignes, puis l’essai (Entrée)</translation>
        </message>
        <message>
            <source>assessment</source>
            <translation type="unfinished">évaluation</translation>
        </message>
        <message>
            <source>practice</source>
            <translation type="unfinished">entraînement</translation>
        </message>
        <message>
            <source>any number</source>
            <translation type="unfinished">sans limite</translation>
        </message>
        <message>
            <source>{left} of {n} left</source>
            <translation type="unfinished">reste {left} sur {n}</translation>
        </message>
        <message>
            <source>{used} done, any number</source>
            <translation type="unfinished">faits : {used}, sans limite</translation>
        </message>
        <message>
            <source>{a} to {b}</source>
            <translation type="unfinished">du {a} au {b}</translation>
        </message>
        <message>
            <source>from {a}</source>
            <translation type="unfinished">dès le {a}</translation>
        </message>
        <message>
            <source>until {b}</source>
            <translation type="unfinished">jusqu’au {b}</translation>
        </message>
        <message>
            <source>✔ passed</source>
            <translation type="unfinished">✔ réussi</translation>
        </message>
        <message>
            <source>best {best:.0f}</source>
            <translation type="unfinished">meilleur {best:.0f}</translation>
        </message>
        <message>
            <source>result not released</source>
            <translation type="unfinished">résultat non publié</translation>
        </message>
        <message>
            <source>▶ next</source>
            <translation type="unfinished">▶ suivant</translation>
        </message>
        <message>
            <source>People</source>
            <translation type="unfinished">Personnes</translation>
        </message>
        <message>
            <source>In order: the next opens when the one before was passed</source>
            <translation type="unfinished">Dans l’ordre : le suivant s’ouvre quand le précédent est réussi</translation>
        </message>
        <message>
            <source>Exercise to add</source>
            <translation type="unfinished">Exercice à ajouter</translation>
        </message>
        <message>
            <source>Version</source>
            <translation type="unfinished">Version</translation>
        </message>
        <message>
            <source>Opens</source>
            <translation type="unfinished">Ouvre</translation>
        </message>
        <message>
            <source>Closes</source>
            <translation type="unfinished">Ferme</translation>
        </message>
        <message>
            <source>separated by commas; empty: everybody</source>
            <translation type="unfinished">séparés par des virgules ; vide : tous</translation>
        </message>
        <message>
            <source>File name</source>
            <translation type="unfinished">Nom du fichier</translation>
        </message>
        <message>
            <source>any</source>
            <translation type="unfinished">illimité</translation>
        </message>
        <message>
            <source>any day</source>
            <translation type="unfinished">tout jour</translation>
        </message>
        <message>
            <source>A day as year-month-day, such as 2026-11-30; empty: any</source>
            <translation type="unfinished">Un jour sous la forme année-mois-jour, par exemple 2026-11-30 ; vide : n’importe lequel</translation>
        </message>
        <message>
            <source>there are: {names}</source>
            <translation type="unfinished">il y a : {names}</translation>
        </message>
        <message>
            <source>there are none yet: add students with their groups first</source>
            <translation type="unfinished">il n’y en a pas encore : ajoutez d’abord des étudiants avec leurs groupes</translation>
        </message>
        <message>
            <source>Groups: no student is in {name}; {there}. Empty means everybody.</source>
            <translation type="unfinished">Groupes : aucun étudiant dans {name} ; {there}. Vide signifie tous.</translation>
        </message>
        <message>
            <source>{n} attempts that may be compared · ● points, click for the debrief · solid: personal best · dashed: median of the last five</source>
            <translation type="unfinished">Essais comparables : {n} · ● points, cliquez pour le débriefing · trait plein : record personnel · tirets : médiane des cinq derniers</translation>
        </message>
        <message>
            <source>No attempt that counts yet.</source>
            <translation type="unfinished">Pas encore d’essai qui compte.</translation>
        </message>
        <message>
            <source>I have written it down</source>
            <translation type="unfinished">Je l’ai noté</translation>
        </message>
        <message>
            <source>It is shown this once only: write it down, tick the box, then close.</source>
            <translation type="unfinished">Ceci n’est montré qu’une fois : notez-le, cochez la case, puis fermez.</translation>
        </message>
        <message>
            <source>page {page} of {pages}</source>
            <translation type="unfinished">page {page} sur {pages}</translation>
        </message>
        <message>
            <source>Report of a group</source>
            <translation type="unfinished">Rapport d’un groupe</translation>
        </message>
        <message>
            <source>{n} students, {m} exercises, {k} attempts that count: scored, comparable, by a person, not declared void.</source>
            <translation type="unfinished">Étudiants : {n}, exercices : {m}, essais qui comptent : {k} (notés, comparables, faits par une personne, non déclarés nuls).</translation>
        </message>
        <message>
            <source>No attempt of a student who signed in yet.</source>
            <translation type="unfinished">Pas encore d’essai d’un étudiant connecté.</translation>
        </message>
        <message>
            <source>Report of a student</source>
            <translation type="unfinished">Rapport d’un étudiant</translation>
        </message>
        <message>
            <source>Group: {groups}</source>
            <translation type="unfinished">Groupe : {groups}</translation>
        </message>
        <message>
            <source>{kind}, {when}, by Acus {version}</source>
            <translation type="unfinished">{kind}, {when}, par Acus {version}</translation>
        </message>
        <message>
            <source>passed</source>
            <translation type="unfinished">réussi</translation>
        </message>
        <message>
            <source>{n} of {m}</source>
            <translation type="unfinished">{n} sur {m}</translation>
        </message>
        <message>
            <source>Best</source>
            <translation type="unfinished">Meilleur</translation>
        </message>
        <message>
            <source>Last</source>
            <translation type="unfinished">Dernier</translation>
        </message>
        <message>
            <source>Trend</source>
            <translation type="unfinished">Tendance</translation>
        </message>
        <message>
            <source>Passed</source>
            <translation type="unfinished">Réussi</translation>
        </message>
        <message>
            <source>not counted: {why}</source>
            <translation type="unfinished">non compté : {why}</translation>
        </message>
        <message>
            <source>● attempt   — best until then   - - median of five</source>
            <translation type="unfinished">● essai   — meilleur jusque-là   - - médiane de cinq</translation>
        </message>
        <message>
            <source>The instructor's remarks</source>
            <translation type="unfinished">Remarques du formateur</translation>
        </message>
        <message>
            <source>Declared void: {why}</source>
            <translation type="unfinished">Déclaré nul : {why}</translation>
        </message>
        <message>
            <source>Save plan</source>
            <translation type="unfinished">Enregistrer le plan</translation>
        </message>
        <message>
            <source>Plans (*{suffix})</source>
            <translation type="unfinished">Plans (*{suffix})</translation>
        </message>
        <message>
            <source>Unsaved plan</source>
            <translation type="unfinished">Plan non enregistré</translation>
        </message>
        <message>
            <source>The plan has unsaved changes. Save them first?</source>
            <translation type="unfinished">Le plan a des modifications non enregistrées. Les enregistrer d’abord ?</translation>
        </message>
        <message>
            <source>Plans (*{suffix} *.json)</source>
            <translation type="unfinished">Plans (*{suffix} *.json)</translation>
        </message>
        <message>
            <source>Open plan</source>
            <translation type="unfinished">Ouvrir un plan</translation>
        </message>
        <message>
            <source>Opened {name}</source>
            <translation type="unfinished">{name} ouvert</translation>
        </message>
        <message>
            <source>● {low:.0f} to 100</source>
            <translation type="unfinished">● {low:.0f} à 100</translation>
        </message>
        <message>
            <source>● {low:.0f} to {high:.0f}</source>
            <translation type="unfinished">● {low:.0f} à {high:.0f}</translation>
        </message>
        <message>
            <source>• {low:.0f} to {high:.0f}</source>
            <translation type="unfinished">• {low:.0f} à {high:.0f}</translation>
        </message>
        <message>
            <source>• below {high:.0f}</source>
            <translation type="unfinished">• moins de {high:.0f}</translation>
        </message>
        <message>
            <source>× not possible</source>
            <translation type="unfinished">× impossible</translation>
        </message>
        <message>
            <source>The skin next to your click is {distance:.1f} mm out of the slice you clicked in: the entry lies in another one.</source>
            <translation type="unfinished">La peau voisine de votre clic est à {distance:.1f} mm de la coupe cliquée : le point d’entrée se trouve dans une autre.</translation>
        </message>
        <message>
            <source>Place  E</source>
            <translation type="unfinished">Placer  E</translation>
        </message>
        <message>
            <source>Place  T</source>
            <translation type="unfinished">Placer  T</translation>
        </message>
        <message>
            <source>Then click near the skin in any view (key E)</source>
            <translation type="unfinished">Cliquez ensuite près de la peau dans une vue (touche E)</translation>
        </message>
        <message>
            <source>Then click inside the patient in any view (key T)</source>
            <translation type="unfinished">Cliquez ensuite à l’intérieur du patient dans une vue (touche T)</translation>
        </message>
        <message>
            <source>Apply suggested rotation</source>
            <translation type="unfinished">Appliquer la rotation proposée</translation>
        </message>
        <message>
            <source>Open…</source>
            <translation type="unfinished">Ouvrir…</translation>
        </message>
        <message>
            <source>Save as…</source>
            <translation type="unfinished">Enregistrer sous…</translation>
        </message>
        <message>
            <source>• unsaved changes</source>
            <translation type="unfinished">• modifications non enregistrées</translation>
        </message>
        <message>
            <source>Patient position</source>
            <translation type="unfinished">Position du patient</translation>
        </message>
        <message>
            <source>Supine (on the back)</source>
            <translation type="unfinished">Décubitus dorsal</translation>
        </message>
        <message>
            <source>Prone (on the belly)</source>
            <translation type="unfinished">Décubitus ventral</translation>
        </message>
        <message>
            <source>Left side down</source>
            <translation type="unfinished">Côté gauche en bas</translation>
        </message>
        <message>
            <source>Right side down</source>
            <translation type="unfinished">Côté droit en bas</translation>
        </message>
        <message>
            <source>not placed yet</source>
            <translation type="unfinished">pas encore placé</translation>
        </message>
        <message>
            <source>Free rotation about the robot's {axis} axis (rotation vector)</source>
            <translation type="unfinished">Rotation libre autour de l’axe {axis} du robot (vecteur de rotation)</translation>
        </message>
        <message>
            <source>Open plan…</source>
            <translation type="unfinished">Ouvrir un plan…</translation>
        </message>
        <message>
            <source>Recent plans</source>
            <translation type="unfinished">Plans récents</translation>
        </message>
        <message>
            <source>Save plan as…</source>
            <translation type="unfinished">Enregistrer le plan sous…</translation>
        </message>
        <message>
            <source>&amp;Edit</source>
            <translation type="unfinished">&amp;Édition</translation>
        </message>
        <message>
            <source>Place entry</source>
            <translation type="unfinished">Placer le point d’entrée</translation>
        </message>
        <message>
            <source>Place target</source>
            <translation type="unfinished">Placer la cible</translation>
        </message>
        <message>
            <source>the plan “{name}”, which has unsaved changes</source>
            <translation type="unfinished">le plan « {name} », qui a des modifications non enregistrées</translation>
        </message>
        <message>
            <source>Map entries for this target</source>
            <translation type="unfinished">Cartographier les points d’entrée vers la cible</translation>
        </message>
        <message>
            <source>Clear</source>
            <translation type="unfinished">Effacer</translation>
        </message>
        <message>
            <source>Take this path</source>
            <translation type="unfinished">Prendre cette trajectoire</translation>
        </message>
        <message>
            <source>Scores straight paths to the target from all over the skin: length, angle to the skin, bone, lung, vessels and gut on the way, distance to structures that warn, and the robot's reach.</source>
            <translation type="unfinished">Note des trajectoires droites vers la cible depuis toute la peau : longueur, angle avec la peau, os, poumon, vaisseaux et intestin rencontrés, distance aux structures qui avertissent, et portée du robot.</translation>
        </message>
        <message>
            <source>{free} of {all} entries are possible.</source>
            <translation type="unfinished">Points d’entrée possibles : {free} sur {all}.</translation>
        </message>
        <message>
            <source>No entry is possible: turn the patient, or choose another target.</source>
            <translation type="unfinished">Aucun point d’entrée n’est possible : tournez le patient ou choisissez une autre cible.</translation>
        </message>
        <message>
            <source>No structure warns: the scores know tissue and reach only.</source>
            <translation type="unfinished">Aucune structure n’avertit : les notes ne tiennent compte que des tissus et de la portée.</translation>
        </message>
        <message>
            <source>Planning help</source>
            <translation type="unfinished">Aide à la planification</translation>
        </message>
        <message>
            <source>Length
[mm]</source>
            <translation type="unfinished">Longueur
[mm]</translation>
        </message>
        <message>
            <source>Angle
[°]</source>
            <translation type="unfinished">Angle
[°]</translation>
        </message>
        <message>
            <source>Nearest
[mm]</source>
            <translation type="unfinished">Plus proche
[mm]</translation>
        </message>
        <message>
            <source>Candidate paths</source>
            <translation type="unfinished">Trajectoires candidates</translation>
        </message>
        <message>
            <source>Place the target first (key T)</source>
            <translation type="unfinished">Placez d’abord la cible (touche T)</translation>
        </message>
        <message>
            <source>The planned path meets: {tissues}.</source>
            <translation type="unfinished">La trajectoire planifiée rencontre : {tissues}.</translation>
        </message>
        <message>
            <source>Scoring paths</source>
            <translation type="unfinished">Notation des trajectoires</translation>
        </message>
        <message>
            <source>Import position of the patient (.tfm)…</source>
            <translation type="unfinished">Importer la position du patient (.tfm)…</translation>
        </message>
        <message>
            <source>Export position of the patient (.tfm)…</source>
            <translation type="unfinished">Exporter la position du patient (.tfm)…</translation>
        </message>
        <message>
            <source>Export position of the patient</source>
            <translation type="unfinished">Exporter la position du patient</translation>
        </message>
        <message>
            <source>Import position of the patient</source>
            <translation type="unfinished">Importer la position du patient</translation>
        </message>
        <message>
            <source>choose an exercise first: its device says where its fulcrum is</source>
            <translation type="unfinished">choisissez d’abord un exercice : son appareil indique où est son point de pivot</translation>
        </message>
        <message>
            <source>{name} goes from the patient to the robot; needed is the other direction: invert it in Slicer</source>
            <translation type="unfinished">{name} va du patient vers le robot ; il faut le sens inverse : inversez-la dans Slicer</translation>
        </message>
        <message>
            <source>Position taken from {name}</source>
            <translation type="unfinished">Position reprise de {name}</translation>
        </message>
        <message>
            <source>Rotation taken from {name}. Its shift would put the robot's fulcrum {off} mm from the entry of this plan and was left out: the entry lies on the fulcrum.</source>
            <translation type="unfinished">Rotation reprise de {name}. Sa translation placerait le point de pivot du robot à {off} mm du point d’entrée de ce plan et a été ignorée : le point d’entrée est sur le point de pivot.</translation>
        </message>
        <message>
            <source>Place the entry on the skin: press E, then click.</source>
            <translation type="unfinished">Placez le point d’entrée sur la peau : appuyez sur E, puis cliquez.</translation>
        </message>
        <message>
            <source>Place the target: press T, then click.</source>
            <translation type="unfinished">Placez la cible : appuyez sur T, puis cliquez.</translation>
        </message>
        <message>
            <source>No device chosen yet.</source>
            <translation type="unfinished">Aucun appareil choisi.</translation>
        </message>
        <message>
            <source>Path {length:.1f} mm, tilt {tilt:.1f}° from vertical</source>
            <translation type="unfinished">Trajectoire {length:.1f} mm, inclinaison {tilt:.1f}° par rapport à la verticale</translation>
        </message>
        <message>
            <source>Out of reach: {reasons}.</source>
            <translation type="unfinished">Hors de portée : {reasons}.</translation>
        </message>
        <message>
            <source>Remedy: {words}</source>
            <translation type="unfinished">Remède : {words}</translation>
        </message>
        <message>
            <source>The robot can follow this path.</source>
            <translation type="unfinished">Le robot peut suivre cette trajectoire.</translation>
        </message>
        <message>
            <source>The robot can follow; what lies on the way is being looked up…</source>
            <translation type="unfinished">Le robot peut suivre ; recherche de ce qui se trouve sur le chemin…</translation>
        </message>
        <message>
            <source>What lies on the way is not known: {reason}.</source>
            <translation type="unfinished">On ne sait pas ce qui se trouve sur le chemin : {reason}.</translation>
        </message>
        <message>
            <source>No bone, lung, vessel, gut or heart is on the way to the target's organ.</source>
            <translation type="unfinished">Ni os, ni poumon, ni vaisseau, ni intestin, ni cœur sur le chemin vers l’organe de la cible.</translation>
        </message>
        <message>
            <source>{tissue} on the way at {depth:.0f} mm</source>
            <translation type="unfinished">{tissue} sur le chemin à {depth:.0f} mm</translation>
        </message>
        <message>
            <source>perhaps {tissue} on the way at {depth:.0f} mm</source>
            <translation type="unfinished">peut-être {tissue} sur le chemin à {depth:.0f} mm</translation>
        </message>
        <message>
            <source>Finish a plan that the robot can follow first.</source>
            <translation type="unfinished">Terminez d’abord un plan que le robot peut suivre.</translation>
        </message>
        <message>
            <source>the CT has no Hounsfield values</source>
            <translation type="unfinished">le CT n’a pas de valeurs Hounsfield</translation>
        </message>
        <message>
            <source>Two by two</source>
            <translation type="unfinished">Deux par deux</translation>
        </message>
        <message>
            <source>One large and three</source>
            <translation type="unfinished">Une grande et trois</translation>
        </message>
        <message>
            <source>Six: slices, needle's planes, 3D</source>
            <translation type="unfinished">Six : coupes, plans de l’aiguille, 3D</translation>
        </message>
        <message>
            <source>Needle: in-plane and probe's-eye</source>
            <translation type="unfinished">Aiguille : dans le plan et vue de la pointe</translation>
        </message>
        <message>
            <source>the assistance</source>
            <translation type="unfinished">l’assistance</translation>
        </message>
        <message>
            <source>what moves the hand, and how far</source>
            <translation type="unfinished">ce qui déplace la main, et de combien</translation>
        </message>
        <message>
            <source>This is an assessment: {what} is the same for everybody.</source>
            <translation type="unfinished">C’est une évaluation. Identique pour tous : {what}.</translation>
        </message>
        <message>
            <source>This attempt is a probe, without help: {what} stays as it is.</source>
            <translation type="unfinished">Cet essai est un essai témoin, sans aide. Ne change pas : {what}.</translation>
        </message>
        <message>
            <source>Control scans guide here: {what} stays as the exercise has it.</source>
            <translation type="unfinished">Ici, les scans de contrôle guident. Reste tel que dans l’exercice : {what}.</translation>
        </message>
        <message>
            <source>The exercise “{title}” sets {what}.</source>
            <translation type="unfinished">L’exercice « {title} » fixe : {what}.</translation>
        </message>
        <message>
            <source>Needle on the slices</source>
            <translation type="unfinished">Aiguille sur les coupes</translation>
        </message>
        <message>
            <source>Bull's-eye</source>
            <translation type="unfinished">Cible de visée</translation>
        </message>
        <message>
            <source>3D view</source>
            <translation type="unfinished">Vue 3D</translation>
        </message>
        <message>
            <source>Camera pictures</source>
            <translation type="unfinished">Images des caméras</translation>
        </message>
        <message>
            <source>Force along the needle</source>
            <translation type="unfinished">Force le long de l’aiguille</translation>
        </message>
        <message>
            <source>Motion of the target</source>
            <translation type="unfinished">Mouvement de la cible</translation>
        </message>
        <message>
            <source>Not shown in this exercise</source>
            <translation type="unfinished">Non affiché dans cet exercice</translation>
        </message>
        <message>
            <source>Not shown in this exercise; switch it on in View ▸ Shown by the exercise</source>
            <translation type="unfinished">Non affiché dans cet exercice ; activez-le dans Affichage ▸ Affiché par l’exercice</translation>
        </message>
        <message>
            <source>this key is a modifier; take another one</source>
            <translation type="unfinished">cette touche est une touche de modification ; prenez-en une autre</translation>
        </message>
        <message>
            <source>{key} has another meaning in the window; take another one</source>
            <translation type="unfinished">{key} a un autre rôle dans la fenêtre ; prenez-en une autre</translation>
        </message>
        <message>
            <source>Key for the forces</source>
            <translation type="unfinished">Touche pour les forces</translation>
        </message>
        <message>
            <source>Press the key or pedal that shall switch the forces on while it is held. A pedal on USB counts as a keyboard.</source>
            <translation type="unfinished">Appuyez sur la touche ou la pédale qui doit activer les forces tant qu’elle est tenue. Une pédale USB compte comme un clavier.</translation>
        </message>
        <message>
            <source>&amp;Robot</source>
            <translation type="unfinished">&amp;Robot</translation>
        </message>
        <message>
            <source>{port} – not plugged in</source>
            <translation type="unfinished">{port} – non branché</translation>
        </message>
        <message>
            <source>Other port</source>
            <translation type="unfinished">Autre port</translation>
        </message>
        <message>
            <source>Port of the robot, for example /dev/ttyUSB0, or what `acus device emulate` has printed</source>
            <translation type="unfinished">Port du robot, par exemple /dev/ttyUSB0, ou ce qu’a affiché `acus device emulate`</translation>
        </message>
        <message>
            <source>The simulated robot needs no commissioning: choose the robot's port in the menu Robot, Use. `acus device emulate` brings one to practise on.</source>
            <translation type="unfinished">Le robot simulé n’a pas besoin de mise en service : choisissez le port du robot dans le menu Robot, Utiliser. `acus device emulate` en fournit un pour s’exercer.</translation>
        </message>
        <message>
            <source>Choose an exercise first: it names the device.</source>
            <translation type="unfinished">Choisissez d’abord un exercice : il désigne l’appareil.</translation>
        </message>
        <message>
            <source>Opening the robot</source>
            <translation type="unfinished">Ouverture du robot</translation>
        </message>
        <message>
            <source>Use</source>
            <translation type="unfinished">Utiliser</translation>
        </message>
        <message>
            <source>Robot's health</source>
            <translation type="unfinished">État du robot</translation>
        </message>
        <message>
            <source>Commissioning…</source>
            <translation type="unfinished">Mise en service…</translation>
        </message>
        <message>
            <source>Arm the simulated robot by a held key too</source>
            <translation type="unfinished">Armer aussi le robot simulé par une touche tenue</translation>
        </message>
        <message>
            <source>Energy gauge</source>
            <translation type="unfinished">Jauge d’énergie</translation>
        </message>
        <message>
            <source>Key for the forces: {key}…</source>
            <translation type="unfinished">Touche pour les forces : {key}…</translation>
        </message>
        <message>
            <source>Simulated robot</source>
            <translation type="unfinished">Robot simulé</translation>
        </message>
        <message>
            <source>no other robot is plugged in</source>
            <translation type="unfinished">aucun autre robot n’est branché</translation>
        </message>
        <message>
            <source>Other port…</source>
            <translation type="unfinished">Autre port…</translation>
        </message>
        <message>
            <source>No robot: pen and webcam…</source>
            <translation type="unfinished">Sans robot : stylo et webcam…</translation>
        </message>
        <message>
            <source>With a real robot, and when the guard acts</source>
            <translation type="unfinished">Avec un vrai robot, et quand la garde agit</translation>
        </message>
        <message>
            <source>Always</source>
            <translation type="unfinished">Toujours</translation>
        </message>
        <message>
            <source>Never</source>
            <translation type="unfinished">Jamais</translation>
        </message>
        <message>
            <source>Board's error</source>
            <translation type="unfinished">Erreur de la carte</translation>
        </message>
        <message>
            <source>{words} (code {code})</source>
            <translation type="unfinished">{words} (code {code})</translation>
        </message>
        <message>
            <source>Error that the board reports; docs/protocol.md lists the codes.</source>
            <translation type="unfinished">Erreur signalée par la carte ; docs/protocol.md donne la liste des codes.</translation>
        </message>
        <message>
            <source>{median:.2f} / {p99:.2f} ms</source>
            <translation type="unfinished">{median:.2f} / {p99:.2f} ms</translation>
        </message>
        <message>
            <source>Round trip</source>
            <translation type="unfinished">Aller-retour</translation>
        </message>
        <message>
            <source>From command to answer, median / 99th percentile of the last {s:.0f} s.</source>
            <translation type="unfinished">De la commande à la réponse, médiane / 99e centile des dernières {s:.0f} s.</translation>
        </message>
        <message>
            <source>Answers</source>
            <translation type="unfinished">Réponses</translation>
        </message>
        <message>
            <source>{replies:.0f}/s · {errors:.1f}/s broken · {lost:.1f}/s lost</source>
            <translation type="unfinished">{replies:.0f}/s · {errors:.1f}/s corrompues · {lost:.1f}/s perdues</translation>
        </message>
        <message>
            <source>Answers of the board, frames with a wrong checksum, and commands without an answer, over the last {s:.0f} s; since the start {replies}, {errors}, {lost}. Broken frames: a shorter cable, away from motor leads, a ferrite.</source>
            <translation type="unfinished">Réponses de la carte, trames à somme de contrôle fausse et commandes sans réponse, sur les dernières {s:.0f} s ; depuis le démarrage {replies}, {errors}, {lost}. Trames corrompues : un câble plus court, loin des fils des moteurs, une ferrite.</translation>
        </message>
        <message>
            <source>connected</source>
            <translation type="unfinished">connecté</translation>
        </message>
        <message>
            <source>in memory</source>
            <translation type="unfinished">en mémoire</translation>
        </message>
        <message>
            <source>connecting</source>
            <translation type="unfinished">connexion</translation>
        </message>
        <message>
            <source>Wait a moment.</source>
            <translation type="unfinished">Patientez un instant.</translation>
        </message>
        <message>
            <source>Check cable and power; the program keeps looking for the robot.</source>
            <translation type="unfinished">Vérifiez le câble et l’alimentation ; le programme continue de chercher le robot.</translation>
        </message>
        <message>
            <source>closed</source>
            <translation type="unfinished">fermé</translation>
        </message>
        <message>
            <source>The port is gone: plug the cable in, or choose the robot again.</source>
            <translation type="unfinished">Le port a disparu : branchez le câble, ou choisissez à nouveau le robot.</translation>
        </message>
        <message>
            <source>wrong protocol version</source>
            <translation type="unfinished">mauvaise version du protocole</translation>
        </message>
        <message>
            <source>The board speaks another version; load the firmware that fits (docs/protocol.md).</source>
            <translation type="unfinished">La carte parle une autre version ; chargez le micrologiciel qui convient (docs/protocol.md).</translation>
        </message>
        <message>
            <source>status {code}</source>
            <translation type="unfinished">état {code}</translation>
        </message>
        <message>
            <source>Link</source>
            <translation type="unfinished">Liaison</translation>
        </message>
        <message>
            <source>How the wire to the robot is.</source>
            <translation type="unfinished">État de la liaison avec le robot.</translation>
        </message>
        <message>
            <source>left {left:.1f}°, right {right:.1f}°</source>
            <translation type="unfinished">gauche {left:.1f}°, droite {right:.1f}°</translation>
        </message>
        <message>
            <source>Joints</source>
            <translation type="unfinished">Articulations</translation>
        </message>
        <message>
            <source>Joint angles now.</source>
            <translation type="unfinished">Angles articulaires actuels.</translation>
        </message>
        <message>
            <source>Velocity by</source>
            <translation type="unfinished">Vitesse par</translation>
        </message>
        <message>
            <source>How joint velocities are estimated; `acus study velocity` compares the ways.</source>
            <translation type="unfinished">Comment les vitesses articulaires sont estimées ; `acus study velocity` compare les méthodes.</translation>
        </message>
        <message>
            <source>says nothing</source>
            <translation type="unfinished">ne dit rien</translation>
        </message>
        <message>
            <source>The loop has not ticked yet. Wait a moment; if it stays so, start the exercise again.</source>
            <translation type="unfinished">La boucle de commande n’a pas encore tourné. Patientez un instant ; si cela dure, relancez l’exercice.</translation>
        </message>
        <message>
            <source>Force</source>
            <translation type="unfinished">Force</translation>
        </message>
        <message>
            <source>Device</source>
            <translation type="unfinished">Appareil</translation>
        </message>
        <message>
            <source>Wire</source>
            <translation type="unfinished">Ligne</translation>
        </message>
        <message>
            <source>Loop</source>
            <translation type="unfinished">Boucle</translation>
        </message>
        <message>
            <source>Commissioning</source>
            <translation type="unfinished">Mise en service</translation>
        </message>
        <message>
            <source>Fault</source>
            <translation type="unfinished">Défaut</translation>
        </message>
        <message>
            <source>While there is a fault the robot gives no force. Its message says what to do.</source>
            <translation type="unfinished">Tant qu’il y a un défaut, le robot ne donne aucune force. Son message dit quoi faire.</translation>
        </message>
        <message>
            <source>Armed</source>
            <translation type="unfinished">Armé</translation>
        </message>
        <message>
            <source>The force rises from 0 to 100 % within a second after arming, and is off at once.</source>
            <translation type="unfinished">La force monte de 0 à 100 % en une seconde après l’armement, et se coupe aussitôt.</translation>
        </message>
        <message>
            <source>Force limit</source>
            <translation type="unfinished">Limite de force</translation>
        </message>
        <message>
            <source>{n:g} N</source>
            <translation type="unfinished">{n:g} N</translation>
        </message>
        <message>
            <source>Largest force at the hand: the device's own limit, nothing holds it lower.</source>
            <translation type="unfinished">Plus grande force à la main : la limite propre de l’appareil, rien ne l’abaisse.</translation>
        </message>
        <message>
            <source>force at {percent:.0f} %</source>
            <translation type="unfinished">force à {percent:.0f} %</translation>
        </message>
        <message>
            <source>Speed governor</source>
            <translation type="unfinished">Limiteur de vitesse</translation>
        </message>
        <message>
            <source>Weakens the force when the needle moves faster than a hand would move it, and ends it when the needle has been let go.</source>
            <translation type="unfinished">Affaiblit la force quand l’aiguille va plus vite qu’une main ne la déplacerait, et la coupe quand l’aiguille a été lâchée.</translation>
        </message>
        <message>
            <source>{v:g} m/s, {e:g} mJ</source>
            <translation type="unfinished">{v:g} m/s, {e:g} mJ</translation>
        </message>
        <message>
            <source>Limit when let go</source>
            <translation type="unfinished">Limite au lâcher</translation>
        </message>
        <message>
            <source>{limit} (by default)</source>
            <translation type="unfinished">{limit} (par défaut)</translation>
        </message>
        <message>
            <source>What the robot's forces may at most give a needle that is let go. </source>
            <translation type="unfinished">Ce que les forces du robot peuvent au plus donner à une aiguille lâchée. </translation>
        </message>
        <message>
            <source>It is given in the robot's profile.</source>
            <translation type="unfinished">La valeur vient du profil du robot.</translation>
        </message>
        <message>
            <source>The robot's profile states none (limits.let_go), so it is held to 0.25 m/s.</source>
            <translation type="unfinished">Le profil du robot n’en indique pas (limits.let_go), il est donc limité à 0,25 m/s.</translation>
        </message>
        <message>
            <source>Depth is between</source>
            <translation type="unfinished">Profondeur entre</translation>
        </message>
        <message>
            <source>{low:.0f} and {high:.0f} mm</source>
            <translation type="unfinished">{low:.0f} et {high:.0f} mm</translation>
        </message>
        <message>
            <source>Force and let-go are limited for every depth in it. An error that is the same in every picture (a needle of another length, a band that has slipped, cameras that were moved) cannot be seen: each millimetre of it makes the force wrong by up to {share:.1f} % here. Measure needle and band with calipers.</source>
            <translation type="unfinished">La force et le lâcher sont limités pour chaque profondeur de cet intervalle. Une erreur identique dans chaque image (aiguille d’une autre longueur, bande qui a glissé, caméras déplacées) ne se voit pas : chaque millimètre fausse ici la force de {share:.1f} % au plus. Mesurez l’aiguille et la bande au pied à coulisse.</translation>
        </message>
        <message>
            <source>Passivity guard</source>
            <translation type="unfinished">Garde de passivité</translation>
        </message>
        <message>
            <source>{stored} stored, {tank} of {bound} left, {loss} removed</source>
            <translation type="unfinished">{stored} stockés, reste {tank} sur {bound}, {loss} retirés</translation>
        </message>
        <message>
            <source>real, {port}</source>
            <translation type="unfinished">réel, {port}</translation>
        </message>
        <message>
            <source>simulated</source>
            <translation type="unfinished">simulé</translation>
        </message>
        <message>
            <source>Device profile, and whether there is a robot of metal. Choose it in the menu Robot.</source>
            <translation type="unfinished">Profil de l’appareil, et s’il y a un robot de métal. Choisissez-le dans le menu Robot.</translation>
        </message>
        <message>
            <source>no serial number</source>
            <translation type="unfinished">pas de numéro de série</translation>
        </message>
        <message>
            <source>Serial number of the board; calibrations are kept by it.</source>
            <translation type="unfinished">Numéro de série de la carte ; les étalonnages sont classés selon lui.</translation>
        </message>
        <message>
            <source>Firmware</source>
            <translation type="unfinished">Micrologiciel</translation>
        </message>
        <message>
            <source>{version}, protocol {protocol}</source>
            <translation type="unfinished">{version}, protocole {protocol}</translation>
        </message>
        <message>
            <source>Program on the board and the version of the wire protocol that it speaks.</source>
            <translation type="unfinished">Programme de la carte et version du protocole de liaison qu’il parle.</translation>
        </message>
        <message>
            <source>Power cycle</source>
            <translation type="unfinished">Mise sous tension</translation>
        </message>
        <message>
            <source>not numbered</source>
            <translation type="unfinished">non numérotée</translation>
        </message>
        <message>
            <source>How often the board was switched on. Homing and sign check count for one power cycle only.</source>
            <translation type="unfinished">Nombre de mises sous tension de la carte. La prise d’origine et la vérification des signes ne valent que pour une seule.</translation>
        </message>
        <message>
            <source>force is {origin}</source>
            <translation type="unfinished">force : {origin}</translation>
        </message>
        <message>
            <source>Force gauge</source>
            <translation type="unfinished">Capteur de force</translation>
        </message>
        <message>
            <source>nothing to commission</source>
            <translation type="unfinished">rien à mettre en service</translation>
        </message>
        <message>
            <source>A simulated robot is homed, its signs are right and its forces are true.</source>
            <translation type="unfinished">Un robot simulé a son origine, ses signes sont corrects et ses forces sont justes.</translation>
        </message>
        <message>
            <source>Menu Robot, Commissioning; it is needed each time the robot was switched on.</source>
            <translation type="unfinished">Menu Robot, Mise en service ; elle est nécessaire après chaque mise sous tension du robot.</translation>
        </message>
        <message>
            <source>Homed</source>
            <translation type="unfinished">Origine prise</translation>
        </message>
        <message>
            <source>Signs checked</source>
            <translation type="unfinished">Signes vérifiés</translation>
        </message>
        <message>
            <source>Whether a commanded newton is a newton on a kitchen scale. Until it is measured on this device, forces stay below 1 N. Menu Robot, Commissioning.</source>
            <translation type="unfinished">Si un newton commandé vaut un newton sur une balance de cuisine. Tant que ce n’est pas mesuré sur cet appareil, les forces restent sous 1 N. Menu Robot, Mise en service.</translation>
        </message>
        <message>
            <source>Force scale</source>
            <translation type="unfinished">Échelle de force</translation>
        </message>
        <message>
            <source>never measured</source>
            <translation type="unfinished">jamais mesurée</translation>
        </message>
        <message>
            <source>{factor:.3f} on {date}</source>
            <translation type="unfinished">{factor:.3f} le {date}</translation>
        </message>
        <message>
            <source>in this power cycle</source>
            <translation type="unfinished">depuis la mise sous tension</translation>
        </message>
        <message>
            <source>not since it was switched on</source>
            <translation type="unfinished">pas depuis la mise sous tension</translation>
        </message>
        <message>
            <source>— left  - - right   ±{scale:.3g} {unit}</source>
            <translation type="unfinished">— gauche  - - droite   ±{scale:.3g} {unit}</translation>
        </message>
        <message>
            <source>Torque</source>
            <translation type="unfinished">Couple</translation>
        </message>
        <message>
            <source>Copy report</source>
            <translation type="unfinished">Copier le rapport</translation>
        </message>
        <message>
            <source>Copies everything on this page as plain text</source>
            <translation type="unfinished">Copie tout le contenu de cette page en texte brut</translation>
        </message>
        <message>
            <source>No robot is running: open a patient with a plan.</source>
            <translation type="unfinished">Aucun robot ne tourne : ouvrez un patient avec un plan.</translation>
        </message>
        <message>
            <source>The robot is starting…</source>
            <translation type="unfinished">Le robot démarre…</translation>
        </message>
        <message>
            <source>Acus {version}: health of the robot</source>
            <translation type="unfinished">Acus {version} : état du robot</translation>
        </message>
        <message>
            <source>Commissioning of {name}</source>
            <translation type="unfinished">Mise en service de {name}</translation>
        </message>
        <message>
            <source>Connect</source>
            <translation type="unfinished">Connexion</translation>
        </message>
        <message>
            <source>Summary</source>
            <translation type="unfinished">Résumé</translation>
        </message>
        <message>
            <source>cancelled, the forces are off</source>
            <translation type="unfinished">annulé, les forces sont coupées</translation>
        </message>
        <message>
            <source>Homing</source>
            <translation type="unfinished">Prise d’origine</translation>
        </message>
        <message>
            <source>The encoders only count. Bringing both links to a known pose tells the program where they are. Needed each time the robot is switched on.</source>
            <translation type="unfinished">Les codeurs ne font que compter. Amener les deux segments dans une position connue indique au programme où ils sont. Nécessaire à chaque mise sous tension du robot.</translation>
        </message>
        <message>
            <source>The robot gives no force in this step.</source>
            <translation type="unfinished">Le robot ne donne aucune force à cette étape.</translation>
        </message>
        <message>
            <source>Encoder offsets</source>
            <translation type="unfinished">Zéros des codeurs</translation>
        </message>
        <message>
            <source>Finds the encoders' zero with the needle in a jig instead of at the stops.</source>
            <translation type="unfinished">Trouve le zéro des codeurs avec l’aiguille dans un gabarit plutôt qu’aux butées.</translation>
        </message>
        <message>
            <source>Sign check</source>
            <translation type="unfinished">Vérification des signes</translation>
        </message>
        <message>
            <source>Finds out whether each encoder counts the right way and each motor pushes the right joint the right way. A robot with a wrong sign runs away instead of guiding. Needed each time the robot was switched on.</source>
            <translation type="unfinished">Vérifie que chaque codeur compte dans le bon sens et que chaque moteur pousse la bonne articulation dans le bon sens. Un robot avec un mauvais signe s’emballe au lieu de guider. Nécessaire à chaque mise sous tension du robot.</translation>
        </message>
        <message>
            <source>Blunt needle. One hand at the switch of the motor supply. Small pulses.</source>
            <translation type="unfinished">Aiguille mousse. Une main sur l’interrupteur d’alimentation des moteurs. Petites impulsions.</translation>
        </message>
        <message>
            <source>Finds out whether a commanded newton is a newton. Until it is measured on this device, forces stay below 1 N.</source>
            <translation type="unfinished">Vérifie qu’un newton commandé vaut un newton. Tant que ce n’est pas mesuré sur cet appareil, les forces restent sous 1 N.</translation>
        </message>
        <message>
            <source>A kitchen scale that shows grams. The robot pushes with 0.2, 0.5 and 0.9 N.</source>
            <translation type="unfinished">Une balance de cuisine qui affiche les grammes. Le robot pousse avec 0,2, 0,5 et 0,9 N.</translation>
        </message>
        <message>
            <source>Measures the round trip of the wire and the time from a torque to the motion. Stiffness that is stable depends on it.</source>
            <translation type="unfinished">Mesure l’aller-retour de la liaison et le temps entre un couple et le mouvement. La raideur stable en dépend.</translation>
        </message>
        <message>
            <source>Hands off the needle. Small pulses.</source>
            <translation type="unfinished">Ne touchez pas l’aiguille. Petites impulsions.</translation>
        </message>
        <message>
            <source>Friction</source>
            <translation type="unfinished">Frottement</translation>
        </message>
        <message>
            <source>Measures the torque at which each joint begins to move, and its friction in motion, so that it can be compensated.</source>
            <translation type="unfinished">Mesure le couple auquel chaque articulation commence à bouger, et son frottement en mouvement, afin de pouvoir les compenser.</translation>
        </message>
        <message>
            <source>Hands off the needle. Slow movements.</source>
            <translation type="unfinished">Ne touchez pas l’aiguille. Mouvements lents.</translation>
        </message>
        <message>
            <source>Calibrates the board's own gauge by weights, so that the force is measured instead of estimated.</source>
            <translation type="unfinished">Étalonne le capteur propre à la carte avec des poids, afin que la force soit mesurée plutôt qu’estimée.</translation>
        </message>
        <message>
            <source>Two or more known weights and a thread.</source>
            <translation type="unfinished">Deux poids connus ou plus et un fil.</translation>
        </message>
        <message>
            <source>not done yet</source>
            <translation type="unfinished">pas encore fait</translation>
        </message>
        <message>
            <source>{when}, before it was switched on again</source>
            <translation type="unfinished">{when}, avant la dernière mise sous tension</translation>
        </message>
        <message>
            <source>Profile</source>
            <translation type="unfinished">Profil</translation>
        </message>
        <message>
            <source>simulated, to practise</source>
            <translation type="unfinished">simulé, pour s’exercer</translation>
        </message>
        <message>
            <source>real</source>
            <translation type="unfinished">réel</translation>
        </message>
        <message>
            <source>Protocol</source>
            <translation type="unfinished">Protocole</translation>
        </message>
        <message>
            <source>cleared for {n:g} N at the hand</source>
            <translation type="unfinished">autorisé pour {n:g} N à la main</translation>
        </message>
        <message>
            <source>Connected</source>
            <translation type="unfinished">Connecté</translation>
        </message>
        <message>
            <source>The program's stop is not safety-rated: use a blunt needle, and keep a hand at the switch of the motor supply (docs/hardware.md). Cancel ends every step at once, with the forces off.</source>
            <translation type="unfinished">L’arrêt du programme n’est pas un arrêt de sécurité certifié : utilisez une aiguille mousse et gardez une main sur l’interrupteur d’alimentation des moteurs (docs/hardware.md). Annuler termine aussitôt chaque étape, forces coupées.</translation>
        </message>
        <message>
            <source>Confirm</source>
            <translation type="unfinished">Confirmer</translation>
        </message>
        <message>
            <source>Cancel: forces off</source>
            <translation type="unfinished">Annuler : forces coupées</translation>
        </message>
        <message>
            <source>Undo the last result</source>
            <translation type="unfinished">Annuler le dernier résultat</translation>
        </message>
        <message>
            <source>running</source>
            <translation type="unfinished">en cours</translation>
        </message>
        <message>
            <source>Begin again</source>
            <translation type="unfinished">Recommencer</translation>
        </message>
        <message>
            <source>type the number that the scale shows, such as 51.5</source>
            <translation type="unfinished">saisissez le nombre qu’affiche la balance, par exemple 51.5</translation>
        </message>
        <message>
            <source>Reading</source>
            <translation type="unfinished">Lecture</translation>
        </message>
        <message>
            <source>Lungs</source>
            <translation type="unfinished">Poumons</translation>
        </message>
        <message>
            <source>Liver</source>
            <translation type="unfinished">Foie</translation>
        </message>
        <message>
            <source>Gallbladder</source>
            <translation type="unfinished">Vésicule biliaire</translation>
        </message>
        <message>
            <source>Stomach</source>
            <translation type="unfinished">Estomac</translation>
        </message>
        <message>
            <source>Spleen</source>
            <translation type="unfinished">Rate</translation>
        </message>
        <message>
            <source>Kidneys</source>
            <translation type="unfinished">Reins</translation>
        </message>
        <message>
            <source>Pancreas</source>
            <translation type="unfinished">Pancréas</translation>
        </message>
        <message>
            <source>Arteries</source>
            <translation type="unfinished">Artères</translation>
        </message>
        <message>
            <source>Veins</source>
            <translation type="unfinished">Veines</translation>
        </message>
        <message>
            <source>Lesion</source>
            <translation type="unfinished">Lésion</translation>
        </message>
        <message>
            <source>Cartilage</source>
            <translation type="unfinished">Cartilage</translation>
        </message>
        <message>
            <source>&amp;View</source>
            <translation type="unfinished">&amp;Affichage</translation>
        </message>
        <message>
            <source>From the front</source>
            <translation type="unfinished">De face</translation>
        </message>
        <message>
            <source>What is at the patient's right is on the left.</source>
            <translation type="unfinished">La droite du patient est à gauche.</translation>
        </message>
        <message>
            <source>From behind</source>
            <translation type="unfinished">De dos</translation>
        </message>
        <message>
            <source>Onto the back.</source>
            <translation type="unfinished">Vue du dos.</translation>
        </message>
        <message>
            <source>From the patient's left</source>
            <translation type="unfinished">De la gauche du patient</translation>
        </message>
        <message>
            <source>The face looks to the left.</source>
            <translation type="unfinished">Le visage regarde à gauche.</translation>
        </message>
        <message>
            <source>From the patient's right</source>
            <translation type="unfinished">De la droite du patient</translation>
        </message>
        <message>
            <source>The face looks to the right; Shift+R.</source>
            <translation type="unfinished">Le visage regarde à droite ; Maj+R.</translation>
        </message>
        <message>
            <source>From the head</source>
            <translation type="unfinished">Depuis la tête</translation>
        </message>
        <message>
            <source>The front is on top.</source>
            <translation type="unfinished">L’avant est en haut.</translation>
        </message>
        <message>
            <source>From the feet</source>
            <translation type="unfinished">Depuis les pieds</translation>
        </message>
        <message>
            <source>The front is on top, as in axial slices.</source>
            <translation type="unfinished">L’avant est en haut, comme dans les coupes axiales.</translation>
        </message>
        <message>
            <source>From the needle</source>
            <translation type="unfinished">Depuis l’aiguille</translation>
        </message>
        <message>
            <source>Along the needle, or the path: what lies ahead.</source>
            <translation type="unfinished">Le long de l’aiguille, ou de la trajectoire : ce qui se trouve devant.</translation>
        </message>
        <message>
            <source>From the operator</source>
            <translation type="unfinished">Depuis l’opérateur</translation>
        </message>
        <message>
            <source>From behind the robot, as you stand at it.</source>
            <translation type="unfinished">De derrière le robot, comme vous vous tenez devant lui.</translation>
        </message>
        <message>
            <source>Whole patient</source>
            <translation type="unfinished">Patient entier</translation>
        </message>
        <message>
            <source>Patient and robot, a little from the side.</source>
            <translation type="unfinished">Patient et robot, un peu de côté.</translation>
        </message>
        <message>
            <source>From where one looked before.</source>
            <translation type="unfinished">D’où l’on regardait avant.</translation>
        </message>
        <message>
            <source>X-ray</source>
            <translation type="unfinished">Radio</translation>
        </message>
        <message>
            <source>Needle, path and target before everything, the body faint.</source>
            <translation type="unfinished">Aiguille, trajectoire et cible devant tout, le corps estompé.</translation>
        </message>
        <message>
            <source>Cut along the needle</source>
            <translation type="unfinished">Coupe selon l’aiguille</translation>
        </message>
        <message>
            <source>What lies before the needle's plane goes; the CT is on the cut.</source>
            <translation type="unfinished">Ce qui est devant le plan de l’aiguille disparaît ; le CT est visible sur la coupe.</translation>
        </message>
        <message>
            <source>Axial, sagittal and coronal slice where they are.</source>
            <translation type="unfinished">Coupes axiale, sagittale et coronale à leur place.</translation>
        </message>
        <message>
            <source>Organs</source>
            <translation type="unfinished">Organes</translation>
        </message>
        <message>
            <source>The lungs; of the built-in patient all organs.</source>
            <translation type="unfinished">Les poumons ; pour le patient intégré, tous les organes.</translation>
        </message>
        <message>
            <source>Light background</source>
            <translation type="unfinished">Fond clair</translation>
        </message>
        <message>
            <source>For projectors.</source>
            <translation type="unfinished">Pour les projecteurs.</translation>
        </message>
        <message>
            <source>Volume rendering</source>
            <translation type="unfinished">Rendu volumique</translation>
        </message>
        <message>
            <source>Surfaces</source>
            <translation type="unfinished">Surfaces</translation>
        </message>
        <message>
            <source>Bone</source>
            <translation type="unfinished">Os</translation>
        </message>
        <message>
            <source>Lung</source>
            <translation type="unfinished">Poumon</translation>
        </message>
        <message>
            <source>Vessels</source>
            <translation type="unfinished">Vaisseaux</translation>
        </message>
        <message>
            <source>Volume rendering needs a graphics card; here {driver} draws.</source>
            <translation type="unfinished">Le rendu volumique demande une carte graphique ; ici, c’est {driver} qui dessine.</translation>
        </message>
        <message>
            <source>nothing yet</source>
            <translation type="unfinished">rien encore</translation>
        </message>
        <message>
            <source>cable at {force:.0f} N</source>
            <translation type="unfinished">câble à {force:.0f} N</translation>
        </message>
        <message>
            <source>dashed: slack cable</source>
            <translation type="unfinished">tirets : câble détendu</translation>
        </message>
        <message>
            <source>body</source>
            <translation type="unfinished">corps</translation>
        </message>
        <message>
            <source>skin</source>
            <translation type="unfinished">peau</translation>
        </message>
        <message>
            <source>organs</source>
            <translation type="unfinished">organes</translation>
        </message>
        <message>
            <source>coarse versions</source>
            <translation type="unfinished">versions grossières</translation>
        </message>
        <message>
            <source>surfaces</source>
            <translation type="unfinished">surfaces</translation>
        </message>
        <message>
            <source>Viewpoint, and what is shown</source>
            <translation type="unfinished">Point de vue, et ce qui est affiché</translation>
        </message>
        <message>
            <source>3D view off: {why}</source>
            <translation type="unfinished">Vue 3D désactivée : {why}</translation>
        </message>
        <message>
            <source>Surfaces {percent:.0f} %</source>
            <translation type="unfinished">Surfaces {percent:.0f} %</translation>
        </message>
        <message>
            <source>x-ray</source>
            <translation type="unfinished">radio</translation>
        </message>
        <message>
            <source>cut along the needle</source>
            <translation type="unfinished">coupe selon l’aiguille</translation>
        </message>
        <message>
            <source>with slices</source>
            <translation type="unfinished">avec coupes</translation>
        </message>
        <message>
            <source>3D</source>
            <translation type="unfinished">3D</translation>
        </message>
        <message>
            <source>and {count} more</source>
            <translation type="unfinished">et {count} de plus</translation>
        </message>
        <message>
            <source>Error 95 %, {scale:.0f}×</source>
            <translation type="unfinished">Erreur 95 %, {scale:.0f}×</translation>
        </message>
        <message>
            <source>Tip error 95 %, true to scale</source>
            <translation type="unfinished">Erreur de pointe 95 %, à l’échelle</translation>
        </message>
        <message>
            <source>Tip error 95 %, {scale:.0f}× enlarged</source>
            <translation type="unfinished">Erreur de pointe 95 %, agrandie {scale:.0f}×</translation>
        </message>
        <message>
            <source>can be used</source>
            <translation type="unfinished">utilisable</translation>
        </message>
        <message>
            <source>Series of {name}</source>
            <translation type="unfinished">Séries de {name}</translation>
        </message>
        <message>
            <source>{count} other files…</source>
            <translation type="unfinished">Autres fichiers : {count}…</translation>
        </message>
        <message>
            <source>{count} series, none of which can be used as it is</source>
            <translation type="unfinished">Séries : {count}, aucune utilisable telle quelle</translation>
        </message>
        <message>
            <source>{count} series, {usable} of which can be used</source>
            <translation type="unfinished">Séries : {count}, dont utilisables : {usable}</translation>
        </message>
        <message>
            <source>Import CT into the library</source>
            <translation type="unfinished">Importer un CT dans la bibliothèque</translation>
        </message>
        <message>
            <source>Looking for CT series</source>
            <translation type="unfinished">Recherche de séries CT</translation>
        </message>
        <message>
            <source>Open CT folder…</source>
            <translation type="unfinished">Ouvrir un dossier CT…</translation>
        </message>
        <message>
            <source>Open CT archive or file…</source>
            <translation type="unfinished">Ouvrir une archive ou un fichier CT…</translation>
        </message>
        <message>
            <source>Series of the folder…</source>
            <translation type="unfinished">Séries du dossier…</translation>
        </message>
        <message>
            <source>Recent CTs</source>
            <translation type="unfinished">CT récents</translation>
        </message>
        <message>
            <source>Library of CTs</source>
            <translation type="unfinished">Bibliothèque de CT</translation>
        </message>
        <message>
            <source>Phantom patient</source>
            <translation type="unfinished">Patient fantôme</translation>
        </message>
        <message>
            <source>Import CT folder, de-identified…</source>
            <translation type="unfinished">Importer un dossier CT, dé-identifié…</translation>
        </message>
        <message>
            <source>Import CT archive or file, de-identified…</source>
            <translation type="unfinished">Importer une archive ou un fichier CT, dé-identifié…</translation>
        </message>
        <message>
            <source>Reading the pictures</source>
            <translation type="unfinished">Lecture des images</translation>
        </message>
        <message>
            <source>Importing, de-identified</source>
            <translation type="unfinished">Importation, dé-identifiée</translation>
        </message>
        <message>
            <source>The files say that there is writing in their pictures: every picture that says so needs a box over it.</source>
            <translation type="unfinished">Les fichiers indiquent que leurs images contiennent du texte : chaque image concernée doit recevoir un cadre qui le couvre.</translation>
        </message>
        <message>
            <source>Taken into the library</source>
            <translation type="unfinished">Ajouté à la bibliothèque</translation>
        </message>
        <message>
            <source>{label}: all {before} images are in the library already; the {given} given are a part</source>
            <translation type="unfinished">{label} : toutes les images ({before}) sont déjà dans la bibliothèque ; les images données ({given}) en font partie</translation>
        </message>
        <message>
            <source>{label}: it was in the library already</source>
            <translation type="unfinished">{label} : déjà dans la bibliothèque</translation>
        </message>
        <message>
            <source>{label}: {count} files, de-identified and checked</source>
            <translation type="unfinished">{label} : fichiers dé-identifiés et vérifiés : {count}</translation>
        </message>
        <message>
            <source>; they replace the {before} of them that lay there</source>
            <translation type="unfinished">; parmi eux, fichiers déjà présents et remplacés : {before}</translation>
        </message>
        <message>
            <source>Picture; drag to draw a box over writing</source>
            <translation type="unfinished">Image ; glissez pour tracer un cadre sur du texte</translation>
        </message>
        <message>
            <source>Names can be written into the picture itself. Nothing finds them by itself: look through the pictures and drag a box over any writing. What is shown black in a box is black in the library for good; the original stays as it is.</source>
            <translation type="unfinished">Des noms peuvent être écrits dans l’image elle-même. Rien ne les trouve automatiquement : parcourez les images et tracez un cadre sur tout texte. Ce qui apparaît noir dans un cadre reste noir pour toujours dans la bibliothèque ; l’original ne change pas.</translation>
        </message>
        <message>
            <source>Look through the pictures for writing. These files hold many pictures each; on such files no boxes can be drawn: do not take them in if there is any.</source>
            <translation type="unfinished">Parcourez les images à la recherche de texte. Ces fichiers contiennent chacun beaucoup d’images ; on ne peut pas y tracer de cadre : ne les ajoutez pas s’il y a du texte.</translation>
        </message>
        <message>
            <source>all pictures</source>
            <translation type="unfinished">toutes les images</translation>
        </message>
        <message>
            <source>picture {number}</source>
            <translation type="unfinished">image {number}</translation>
        </message>
        <message>
            <source>Look at the pictures before they are imported</source>
            <translation type="unfinished">Regarder les images avant l’importation</translation>
        </message>
        <message>
            <source>Brightest of all pictures</source>
            <translation type="unfinished">Maximum de toutes les images</translation>
        </message>
        <message>
            <source>Import, de-identified</source>
            <translation type="unfinished">Importer, dé-identifié</translation>
        </message>
        <message>
            <source>All values</source>
            <translation type="unfinished">Toutes les valeurs</translation>
        </message>
        <message>
            <source>on all pictures</source>
            <translation type="unfinished">sur toutes les images</translation>
        </message>
        <message>
            <source>on this picture only</source>
            <translation type="unfinished">sur cette image seulement</translation>
        </message>
        <message>
            <source>Picture</source>
            <translation type="unfinished">Image</translation>
        </message>
        <message>
            <source>Of every pixel the highest value in any picture: writing in one of them shows.</source>
            <translation type="unfinished">Pour chaque pixel, la plus haute valeur de toutes les images : un texte présent dans l’une d’elles se voit.</translation>
        </message>
        <message>
            <source>all {count} at once</source>
            <translation type="unfinished">les {count} à la fois</translation>
        </message>
        <message>
            <source>picture {number} of {count}</source>
            <translation type="unfinished">image {number} sur {count}</translation>
        </message>
        <message>
            <source>Window</source>
            <translation type="unfinished">Fenêtrage</translation>
        </message>
        <message>
            <source>New boxes</source>
            <translation type="unfinished">Nouveaux cadres</translation>
        </message>
        <message>
            <source>Open CT folder</source>
            <translation type="unfinished">Ouvrir un dossier CT</translation>
        </message>
        <message>
            <source>CT archives and files</source>
            <translation type="unfinished">Archives et fichiers CT</translation>
        </message>
        <message>
            <source>All (*)</source>
            <translation type="unfinished">Tous (*)</translation>
        </message>
        <message>
            <source>Open CT file</source>
            <translation type="unfinished">Ouvrir un fichier CT</translation>
        </message>
        <message>
            <source>Looking for CT series in {name}</source>
            <translation type="unfinished">Recherche de séries CT dans {name}</translation>
        </message>
        <message>
            <source>Preparing the phantom patient</source>
            <translation type="unfinished">Préparation du patient fantôme</translation>
        </message>
        <message>
            <source>Reading CT</source>
            <translation type="unfinished">Lecture du CT</translation>
        </message>
        <message>
            <source>About Acus</source>
            <translation type="unfinished">À propos d’Acus</translation>
        </message>
        <message>
            <source>Acus {version}</source>
            <translation type="unfinished">Acus {version}</translation>
        </message>
        <message>
            <source>Libraries, as installed (being read):</source>
            <translation type="unfinished">Bibliothèques installées (lecture en cours) :</translation>
        </message>
        <message>
            <source>Libraries, as installed:</source>
            <translation type="unfinished">Bibliothèques installées :</translation>
        </message>
        <message>
            <source>The libraries cannot be listed: {error}</source>
            <translation type="unfinished">Impossible de lister les bibliothèques : {error}</translation>
        </message>
        <message>
            <source>Acus is under the Apache License 2.0 (LICENSE, NOTICE).</source>
            <translation type="unfinished">Acus est sous licence Apache 2.0 (LICENSE, NOTICE).</translation>
        </message>
        <message>
            <source>Qt {version} and PySide6 are used under the GNU Lesser General Public License (LGPL), version 3: they lie beside the program as libraries of their own, and you may replace them by versions that you have changed.</source>
            <translation type="unfinished">Qt {version} et PySide6 sont utilisés sous la GNU Lesser General Public License (LGPL), version 3 : ce sont des bibliothèques distinctes à côté du programme, et vous pouvez les remplacer par des versions que vous avez modifiées.</translation>
        </message>
        <message>
            <source>Library</source>
            <translation type="unfinished">Bibliothèque</translation>
        </message>
        <message>
            <source>Licence</source>
            <translation type="unfinished">Licence</translation>
        </message>
        <message>
            <source>Report a problem</source>
            <translation type="unfinished">Signaler un problème</translation>
        </message>
        <message>
            <source>This is all that a report holds: no names, no pictures, no paths. Look through it, say above it what you did and what you expected, and send it to whoever looks after this computer. The program sends nothing by itself.</source>
            <translation type="unfinished">C’est tout ce que contient un rapport : aucun nom, aucune image, aucun chemin. Relisez-le, indiquez au-dessus ce que vous avez fait et ce que vous attendiez, puis envoyez-le à la personne qui s’occupe de cet ordinateur. Le programme n’envoie rien de lui-même.</translation>
        </message>
        <message>
            <source>Copy</source>
            <translation type="unfinished">Copier</translation>
        </message>
        <message>
            <source>✔ copied</source>
            <translation type="unfinished">✔ copié</translation>
        </message>
        <message>
            <source>Save the report</source>
            <translation type="unfinished">Enregistrer le rapport</translation>
        </message>
        <message>
            <source>✖ not saved: {why}</source>
            <translation type="unfinished">✖ non enregistré : {why}</translation>
        </message>
        <message>
            <source>✔ saved</source>
            <translation type="unfinished">✔ enregistré</translation>
        </message>
        <message>
            <source>User guide</source>
            <translation type="unfinished">Guide d’utilisation</translation>
        </message>
        <message>
            <source>The user guide is not installed with this program. In a checkout `make docs` builds it. The page that was asked for is docs/{name}.</source>
            <translation type="unfinished">Le guide d’utilisation n’est pas installé avec ce programme. Dans une copie du dépôt, `make docs` le produit. La page demandée est docs/{name}.</translation>
        </message>
        <message>
            <source>As this computer: {language}</source>
            <translation type="unfinished">Comme cet ordinateur : {language}</translation>
        </message>
        <message>
            <source>Language</source>
            <translation type="unfinished">Langue</translation>
        </message>
        <message>
            <source>An attempt is running: end it before another language is chosen</source>
            <translation type="unfinished">Un essai est en cours : terminez-le avant de choisir une autre langue</translation>
        </message>
        <message>
            <source>Details</source>
            <translation type="unfinished">Détails</translation>
        </message>
        <message>
            <source>Close message</source>
            <translation type="unfinished">Fermer le message</translation>
        </message>
        <message>
            <source>Something went wrong: {what}</source>
            <translation type="unfinished">Un problème est survenu : {what}</translation>
        </message>
        <message>
            <source>&amp;Help</source>
            <translation type="unfinished">A&amp;ide</translation>
        </message>
        <message>
            <source>Slices: mouse ({scheme})</source>
            <translation type="unfinished">Coupes : souris ({scheme})</translation>
        </message>
        <message>
            <source>Slices: keys ({scheme})</source>
            <translation type="unfinished">Coupes : touches ({scheme})</translation>
        </message>
        <message>
            <source>window presets, the file's own</source>
            <translation type="unfinished">fenêtrages prédéfinis, celui du fichier</translation>
        </message>
        <message>
            <source>place entry, place target: then click in any view, 3D too</source>
            <translation type="unfinished">placer le point d’entrée, la cible : puis cliquer dans une vue, 3D comprise</translation>
        </message>
        <message>
            <source>Drag a mark</source>
            <translation type="unfinished">Glisser un repère</translation>
        </message>
        <message>
            <source>move it</source>
            <translation type="unfinished">le déplacer</translation>
        </message>
        <message>
            <source>Esc</source>
            <translation type="unfinished">Échap</translation>
        </message>
        <message>
            <source>stop placing</source>
            <translation type="unfinished">arrêter le placement</translation>
        </message>
        <message>
            <source>undo, redo</source>
            <translation type="unfinished">annuler, rétablir</translation>
        </message>
        <message>
            <source>save plan, save as</source>
            <translation type="unfinished">enregistrer le plan, enregistrer sous</translation>
        </message>
        <message>
            <source>measure: distance, angle, HU, region</source>
            <translation type="unfinished">mesurer : distance, angle, UH, région</translation>
        </message>
        <message>
            <source>pen and webcam: a needle without a robot</source>
            <translation type="unfinished">stylo et webcam : une aiguille sans robot</translation>
        </message>
        <message>
            <source>open CT folder, open plan</source>
            <translation type="unfinished">ouvrir un dossier CT, ouvrir un plan</translation>
        </message>
        <message>
            <source>Left, middle, right drag</source>
            <translation type="unfinished">Glisser à gauche, au milieu, à droite</translation>
        </message>
        <message>
            <source>who sits here: student, instructor, technician</source>
            <translation type="unfinished">qui est ici : étudiant, formateur, technicien</translation>
        </message>
        <message>
            <source>turn, pan, zoom</source>
            <translation type="unfinished">tourner, déplacer, zoomer</translation>
        </message>
        <message>
            <source>look from that side</source>
            <translation type="unfinished">regarder de ce côté</translation>
        </message>
        <message>
            <source>look along the needle, as the operator</source>
            <translation type="unfinished">regarder le long de l’aiguille, comme l’opérateur</translation>
        </message>
        <message>
            <source>Space, r; Backspace</source>
            <translation type="unfinished">Espace, r ; Retour arrière</translation>
        </message>
        <message>
            <source>whole patient; from where one looked before</source>
            <translation type="unfinished">patient entier ; d’où l’on regardait avant</translation>
        </message>
        <message>
            <source>x-ray; cut along the needle</source>
            <translation type="unfinished">radio ; coupe selon l’aiguille</translation>
        </message>
        <message>
            <source>slices as planes; organs</source>
            <translation type="unfinished">coupes en plans ; organes</translation>
        </message>
        <message>
            <source>volume rendering; light background</source>
            <translation type="unfinished">rendu volumique ; fond clair</translation>
        </message>
        <message>
            <source>Attempt</source>
            <translation type="unfinished">Essai</translation>
        </message>
        <message>
            <source>start the attempt; anything new is explained first</source>
            <translation type="unfinished">démarrer l’essai ; toute nouveauté est d’abord expliquée</translation>
        </message>
        <message>
            <source>briefing; an expert shows it</source>
            <translation type="unfinished">consignes ; un expert montre l’exercice</translation>
        </message>
        <message>
            <source>control scan</source>
            <translation type="unfinished">scan de contrôle</translation>
        </message>
        <message>
            <source>Enter</source>
            <translation type="unfinished">Entrée</translation>
        </message>
        <message>
            <source>end the attempt</source>
            <translation type="unfinished">terminer l’essai</translation>
        </message>
        <message>
            <source>in an attempt: all panels; live pictures or the scan</source>
            <translation type="unfinished">pendant un essai : tous les panneaux ; images en direct ou scan</translation>
        </message>
        <message>
            <source>Hold Esc</source>
            <translation type="unfinished">Tenir Échap</translation>
        </message>
        <message>
            <source>abort: force to zero at once</source>
            <translation type="unfinished">abandonner : force aussitôt à zéro</translation>
        </message>
        <message>
            <source>Hold H, or a pedal</source>
            <translation type="unfinished">Tenir H, ou une pédale</translation>
        </message>
        <message>
            <source>forces on, where they are armed by holding</source>
            <translation type="unfinished">forces actives, là où on les arme en tenant la touche</translation>
        </message>
        <message>
            <source>slices follow the tip; bull's-eye</source>
            <translation type="unfinished">les coupes suivent la pointe ; cible de visée</translation>
        </message>
        <message>
            <source>Drag, Q, E in the bull's-eye</source>
            <translation type="unfinished">Glisser, Q, E dans la cible de visée</translation>
        </message>
        <message>
            <source>tilt the needle; turn a bevelled one</source>
            <translation type="unfinished">incliner l’aiguille ; tourner une aiguille à biseau</translation>
        </message>
        <message>
            <source>Wheel, Page keys in the bull's-eye</source>
            <translation type="unfinished">Molette, touches Page dans la cible de visée</translation>
        </message>
        <message>
            <source>depth 1 mm, with Shift 0.2 mm</source>
            <translation type="unfinished">profondeur 1 mm, avec Maj 0,2 mm</translation>
        </message>
        <message>
            <source>Keys and mouse</source>
            <translation type="unfinished">Clavier et souris</translation>
        </message>
        <message>
            <source>next</source>
            <translation type="unfinished">suivant</translation>
        </message>
        <message>
            <source>Search exercises</source>
            <translation type="unfinished">Chercher un exercice</translation>
        </message>
        <message>
            <source>Begin exercise</source>
            <translation type="unfinished">Commencer</translation>
        </message>
        <message>
            <source>Exercises</source>
            <translation type="unfinished">Exercices</translation>
        </message>
        <message>
            <source>Three-minute tour</source>
            <translation type="unfinished">Visite de trois minutes</translation>
        </message>
        <message>
            <source>Not now</source>
            <translation type="unfinished">Pas maintenant</translation>
        </message>
        <message>
            <source>done {n}</source>
            <translation type="unfinished">faits : {n}</translation>
        </message>
        <message>
            <source>best {points}</source>
            <translation type="unfinished">meilleur {points}</translation>
        </message>
        <message>
            <source>No exercise holds these words: clear the search to see all.</source>
            <translation type="unfinished">Aucun exercice ne contient ces mots : effacez la recherche pour tous les voir.</translation>
        </message>
        <message>
            <source>No exercises found.</source>
            <translation type="unfinished">Aucun exercice trouvé.</translation>
        </message>
        <message>
            <source>CT-guided needle insertion, practised by hand</source>
            <translation type="unfinished">La ponction sous scanner, exercée à la main</translation>
        </message>
        <message>
            <source>First time here?</source>
            <translation type="unfinished">Première fois ici ?</translation>
        </message>
        <message>
            <source>Your own CT</source>
            <translation type="unfinished">Votre propre CT</translation>
        </message>
        <message>
            <source>CTs that you open are listed here: File ▸ Open CT folder…</source>
            <translation type="unfinished">Les CT que vous ouvrez apparaissent ici : Fichier ▸ Ouvrir un dossier CT…</translation>
        </message>
        <message>
            <source>any name: your progress is kept under it</source>
            <translation type="unfinished">n’importe quel nom : vos progrès y sont conservés</translation>
        </message>
        <message>
            <source>Your name</source>
            <translation type="unfinished">Votre nom</translation>
        </message>
        <message>
            <source>You practise as</source>
            <translation type="unfinished">S’exercer sous le nom</translation>
        </message>
        <message>
            <source>Difficulty</source>
            <translation type="unfinished">Difficulté</translation>
        </message>
        <message>
            <source>Done</source>
            <translation type="unfinished">Faits</translation>
        </message>
        <message>
            <source>Done and best: everybody at this station. Sign in to see your own.</source>
            <translation type="unfinished">Faits et meilleur : tous ceux de ce poste. Connectez-vous pour voir les vôtres.</translation>
        </message>
        <message>
            <source>Done and best: {name}.</source>
            <translation type="unfinished">Faits et meilleur : {name}.</translation>
        </message>
        <message>
            <source>Done and best: everybody at this station.</source>
            <translation type="unfinished">Faits et meilleur : tous ceux de ce poste.</translation>
        </message>
        <message>
            <source>Sign in as a student to see what you have done.</source>
            <translation type="unfinished">Connectez-vous comme étudiant pour voir ce que vous avez fait.</translation>
        </message>
        <message>
            <source>Next (Enter)</source>
            <translation type="unfinished">Suivant (Entrée)</translation>
        </message>
        <message>
            <source>Leave (Esc)</source>
            <translation type="unfinished">Quitter (Échap)</translation>
        </message>
        <message>
            <source>Done (Enter)</source>
            <translation type="unfinished">Terminé (Entrée)</translation>
        </message>
        <message>
            <source>The patient</source>
            <translation type="unfinished">Le patient</translation>
        </message>
        <message>
            <source>Every exercise has its patient: a CT and, mostly, a planned path from the entry on the skin to the target. Enter begins: first a briefing, then the attempt. Difficulty rises downwards.</source>
            <translation type="unfinished">Chaque exercice a son patient : un CT et, le plus souvent, une trajectoire planifiée du point d’entrée sur la peau à la cible. Entrée commence : d’abord les consignes, puis l’essai. La difficulté augmente vers le bas.</translation>
        </message>
        <message>
            <source>The slices</source>
            <translation type="unfinished">Les coupes</translation>
        </message>
        <message>
            <source>The CT in axial, sagittal and coronal slices, with the plan and, where the exercise shows it, the live needle. The wheel leafs through them, a click moves the cross, the right button changes the window. The 3D view is below.</source>
            <translation type="unfinished">Le CT en coupes axiales, sagittales et coronales, avec le plan et, là où l’exercice la montre, l’aiguille en direct. La molette les fait défiler, un clic déplace la croix, le bouton droit change le fenêtrage. La vue 3D est en dessous.</translation>
        </message>
        <message>
            <source>The bull's-eye</source>
            <translation type="unfinished">La cible de visée</translation>
        </message>
        <message>
            <source>The main instrument: how the needle points against the path, and how deep it is. Bring the mark into the middle, then push to the target. During an attempt one line above always says the next step.</source>
            <translation type="unfinished">L’instrument principal : comment l’aiguille est orientée par rapport à la trajectoire, et à quelle profondeur elle est. Amenez le repère au centre, puis avancez jusqu’à la cible. Pendant un essai, une ligne au-dessus indique toujours l’étape suivante.</translation>
        </message>
        <message>
            <source>The hand</source>
            <translation type="unfinished">La main</translation>
        </message>
        <message>
            <source>Without a robot the mouse is the hand: drag in the bull's-eye to tilt, turn the wheel to push or pull. A tablet or a gamepad can take its place. With a robot you hold the needle itself.</source>
            <translation type="unfinished">Sans robot, la souris est la main : glissez dans la cible de visée pour incliner, tournez la molette pour avancer ou retirer. Une tablette ou une manette peut la remplacer. Avec un robot, vous tenez l’aiguille elle-même.</translation>
        </message>
        <message>
            <source>The robot</source>
            <translation type="unfinished">Le robot</translation>
        </message>
        <message>
            <source>Whether robot, cameras and recording are well. As long as nothing here is yellow or red you need not look; a click says more. Holding Esc takes all force off at once, whenever you like.</source>
            <translation type="unfinished">Si le robot, les caméras et l’enregistrement vont bien. Tant que rien ici n’est jaune ou rouge, inutile de regarder ; un clic en dit plus. Tenir Échap coupe aussitôt toute force, quand vous voulez.</translation>
        </message>
        <message>
            <source>The debrief</source>
            <translation type="unfinished">Le débriefing</translation>
        </message>
        <message>
            <source>When you end the attempt (Enter) it is scored at once: where the needle ended, what cost points and what to do otherwise, everything to be replayed, and which exercise comes next. All attempts stay in Past sessions (F7).</source>
            <translation type="unfinished">Quand vous terminez l’essai (Entrée), il est noté aussitôt : où l’aiguille s’est arrêtée, ce qui a coûté des points et ce qu’il faut faire autrement, le tout à relire, et quel exercice vient ensuite. Tous les essais restent dans Séances passées (F7).</translation>
        </message>
        <message>
            <source>Layout</source>
            <translation type="unfinished">Disposition</translation>
        </message>
        <message>
            <source>Window presets</source>
            <translation type="unfinished">Fenêtrages prédéfinis</translation>
        </message>
        <message>
            <source>One window for all panes</source>
            <translation type="unfinished">Un fenêtrage pour toutes les vues</translation>
        </message>
        <message>
            <source>Lock window and level</source>
            <translation type="unfinished">Verrouiller le fenêtrage</translation>
        </message>
        <message>
            <source>Invert grey</source>
            <translation type="unfinished">Inverser les gris</translation>
        </message>
        <message>
            <source>Slices follow the needle tip</source>
            <translation type="unfinished">Les coupes suivent la pointe de l’aiguille</translation>
        </message>
        <message>
            <source>Bull's-eye beside the slices</source>
            <translation type="unfinished">Cible de visée à côté des coupes</translation>
        </message>
        <message>
            <source>Legend of the bull's-eye</source>
            <translation type="unfinished">Légende de la cible de visée</translation>
        </message>
        <message>
            <source>The hand moves the hub, not the tip</source>
            <translation type="unfinished">La main déplace l’embase, pas la pointe</translation>
        </message>
        <message>
            <source>Shown by the exercise</source>
            <translation type="unfinished">Affiché par l’exercice</translation>
        </message>
        <message>
            <source>Crosshair to target</source>
            <translation type="unfinished">Réticule sur la cible</translation>
        </message>
        <message>
            <source>Needle's planes</source>
            <translation type="unfinished">Plans de l’aiguille</translation>
        </message>
        <message>
            <source>Straighten all planes</source>
            <translation type="unfinished">Redresser tous les plans</translation>
        </message>
        <message>
            <source>Operator's side</source>
            <translation type="unfinished">Côté de l’opérateur</translation>
        </message>
        <message>
            <source>Mouse and keys</source>
            <translation type="unfinished">Souris et touches</translation>
        </message>
        <message>
            <source>Projector</source>
            <translation type="unfinished">Projecteur</translation>
        </message>
        <message>
            <source>Projector mode: all three</source>
            <translation type="unfinished">Mode projecteur : les trois</translation>
        </message>
        <message>
            <source>Light colours</source>
            <translation type="unfinished">Couleurs claires</translation>
        </message>
        <message>
            <source>Large text</source>
            <translation type="unfinished">Grand texte</translation>
        </message>
        <message>
            <source>Hide names</source>
            <translation type="unfinished">Masquer les noms</translation>
        </message>
        <message>
            <source>Full screen</source>
            <translation type="unfinished">Plein écran</translation>
        </message>
        <message>
            <source>Left-handed: panel on the right</source>
            <translation type="unfinished">Gaucher : panneau à droite</translation>
        </message>
        <message>
            <source>As in {scheme}</source>
            <translation type="unfinished">Comme dans {scheme}</translation>
        </message>
        <message>
            <source>Level the other way round</source>
            <translation type="unfinished">Niveau dans l’autre sens</translation>
        </message>
        <message>
            <source>A file of your own cannot be used: {why}</source>
            <translation type="unfinished">Un de vos fichiers est inutilisable : {why}</translation>
        </message>
        <message>
            <source>A folder of plug-ins cannot be used: {why}</source>
            <translation type="unfinished">Un dossier de modules d’extension est inutilisable : {why}</translation>
        </message>
        <message>
            <source>the CT {name}</source>
            <translation type="unfinished">le CT {name}</translation>
        </message>
        <message>
            <source>the attempt that is running: it ends and is saved, without a score</source>
            <translation type="unfinished">l’essai en cours : il se termine et est enregistré, sans note</translation>
        </message>
        <message>
            <source>Opening a patient replaces:</source>
            <translation type="unfinished">Ouvrir un patient remplace :</translation>
        </message>
        <message>
            <source>Save the plan first?</source>
            <translation type="unfinished">Enregistrer d’abord le plan ?</translation>
        </message>
        <message>
            <source>Open another patient</source>
            <translation type="unfinished">Ouvrir un autre patient</translation>
        </message>
        <message>
            <source>Start waits: another patient is being opened.</source>
            <translation type="unfinished">Le démarrage attend : un autre patient s’ouvre.</translation>
        </message>
        <message>
            <source>signed in as the instructor</source>
            <translation type="unfinished">connecté comme formateur</translation>
        </message>
        <message>
            <source>Start page</source>
            <translation type="unfinished">Page d’accueil</translation>
        </message>
        <message>
            <source>Workspace</source>
            <translation type="unfinished">Espace de travail</translation>
        </message>
        <message>
            <source>Help on this part</source>
            <translation type="unfinished">Aide sur cette partie</translation>
        </message>
        <message>
            <source>Report a problem…</source>
            <translation type="unfinished">Signaler un problème…</translation>
        </message>
        <message>
            <source>one slice on, back</source>
            <translation type="unfinished">une coupe en avant, en arrière</translation>
        </message>
        <message>
            <source>ten slices on, back</source>
            <translation type="unfinished">dix coupes en avant, en arrière</translation>
        </message>
        <message>
            <source>first, last slice</source>
            <translation type="unfinished">première, dernière coupe</translation>
        </message>
        <message>
            <source>zoom in, out</source>
            <translation type="unfinished">zoom avant, arrière</translation>
        </message>
        <message>
            <source>fit to pane</source>
            <translation type="unfinished">ajuster à la vue</translation>
        </message>
        <message>
            <source>reset zoom, window and slab</source>
            <translation type="unfinished">réinitialiser zoom, fenêtrage et coupe épaisse</translation>
        </message>
        <message>
            <source>left drag zooms, until Esc</source>
            <translation type="unfinished">glisser à gauche zoome, jusqu’à Échap</translation>
        </message>
        <message>
            <source>invert grey</source>
            <translation type="unfinished">inverser les gris</translation>
        </message>
        <message>
            <source>turn right, left by 90°</source>
            <translation type="unfinished">tourner à droite, à gauche de 90°</translation>
        </message>
        <message>
            <source>mirror left-right, top-bottom</source>
            <translation type="unfinished">miroir gauche-droite, haut-bas</translation>
        </message>
        <message>
            <source>slab thinner, thicker</source>
            <translation type="unfinished">coupe épaisse : plus fine, plus épaisse</translation>
        </message>
        <message>
            <source>slab: mean, MIP, MinIP</source>
            <translation type="unfinished">coupe épaisse : moyenne, MIP, MinIP</translation>
        </message>
        <message>
            <source>cine: start, stop</source>
            <translation type="unfinished">ciné : démarrer, arrêter</translation>
        </message>
        <message>
            <source>maximise or restore the pane</source>
            <translation type="unfinished">agrandir ou rétablir la vue</translation>
        </message>
        <message>
            <source>previous, next pane</source>
            <translation type="unfinished">vue précédente, suivante</translation>
        </message>
        <message>
            <source>move the crosshair</source>
            <translation type="unfinished">déplacer le réticule</translation>
        </message>
        <message>
            <source>with E or T before: place at the crosshair</source>
            <translation type="unfinished">après E ou T : placer au réticule</translation>
        </message>
        <message>
            <source>menu of the pane</source>
            <translation type="unfinished">menu de la vue</translation>
        </message>
        <message>
            <source>stop the current action</source>
            <translation type="unfinished">arrêter l’action en cours</translation>
        </message>
        <message>
            <source>up</source>
            <translation type="unfinished">haut</translation>
        </message>
        <message>
            <source>down</source>
            <translation type="unfinished">bas</translation>
        </message>
        <message>
            <source>window (right: wider) and level ({way}: higher)</source>
            <translation type="unfinished">largeur de fenêtre (droite : plus large) et niveau ({way} : plus élevé)</translation>
        </message>
        <message>
            <source>pan</source>
            <translation type="unfinished">déplacer</translation>
        </message>
        <message>
            <source>zoom</source>
            <translation type="unfinished">zoomer</translation>
        </message>
        <message>
            <source>crosshair in all views</source>
            <translation type="unfinished">réticule dans toutes les vues</translation>
        </message>
        <message>
            <source>best window for the box</source>
            <translation type="unfinished">meilleur fenêtrage pour le cadre</translation>
        </message>
        <message>
            <source>scroll through slices</source>
            <translation type="unfinished">faire défiler les coupes</translation>
        </message>
        <message>
            <source>Wheel</source>
            <translation type="unfinished">Molette</translation>
        </message>
        <message>
            <source>Shift+move</source>
            <translation type="unfinished">Maj+déplacer</translation>
        </message>
        <message>
            <source>Right click</source>
            <translation type="unfinished">Clic droit</translation>
        </message>
        <message>
            <source>menu: windows, slab, turn, cine</source>
            <translation type="unfinished">menu : fenêtrages, coupe épaisse, rotation, ciné</translation>
        </message>
        <message>
            <source>Double click</source>
            <translation type="unfinished">Double clic</translation>
        </message>
        <message>
            <source>maximise or restore a pane</source>
            <translation type="unfinished">agrandir ou rétablir une vue</translation>
        </message>
        <message>
            <source>Ctrl+double click</source>
            <translation type="unfinished">Ctrl+double clic</translation>
        </message>
        <message>
            <source>reset window and level</source>
            <translation type="unfinished">réinitialiser le fenêtrage</translation>
        </message>
        <message>
            <source>Left drag</source>
            <translation type="unfinished">Glisser à gauche</translation>
        </message>
        <message>
            <source>Middle drag</source>
            <translation type="unfinished">Glisser au milieu</translation>
        </message>
        <message>
            <source>Right drag</source>
            <translation type="unfinished">Glisser à droite</translation>
        </message>
        <message>
            <source>Target, TRE 95 %</source>
            <translation type="unfinished">Cible, TRE 95 %</translation>
        </message>
        <message>
            <source>Target {n}</source>
            <translation type="unfinished">Cible {n}</translation>
        </message>
        <message>
            <source>not tracked</source>
            <translation type="unfinished">non suivie</translation>
        </message>
        <message>
            <source>{distance:.0f} mm {side}</source>
            <translation type="unfinished">{distance:.0f} mm {side}</translation>
        </message>
        <message>
            <source>no needle, no path</source>
            <translation type="unfinished">ni aiguille, ni trajectoire</translation>
        </message>
        <message>
            <source>through two points</source>
            <translation type="unfinished">par deux points</translation>
        </message>
        <message>
            <source>planned path</source>
            <translation type="unfinished">trajectoire planifiée</translation>
        </message>
        <message>
            <source>follows the needle</source>
            <translation type="unfinished">suit l’aiguille</translation>
        </message>
        <message>
            <source>Follow the needle</source>
            <translation type="unfinished">Suivre l’aiguille</translation>
        </message>
        <message>
            <source>Hold here</source>
            <translation type="unfinished">Maintenir ici</translation>
        </message>
        <message>
            <source>Along the planned path</source>
            <translation type="unfinished">Le long de la trajectoire planifiée</translation>
        </message>
        <message>
            <source>Through two points…</source>
            <translation type="unfinished">Par deux points…</translation>
        </message>
        <message>
            <source>Lines in the patient views</source>
            <translation type="unfinished">Lignes dans les vues du patient</translation>
        </message>
        <message>
            <source>Keep this window…</source>
            <translation type="unfinished">Garder ce fenêtrage…</translation>
        </message>
        <message>
            <source>Forget a kept window</source>
            <translation type="unfinished">Oublier un fenêtrage gardé</translation>
        </message>
        <message>
            <source>Turn and mirror</source>
            <translation type="unfinished">Tourner et refléter</translation>
        </message>
        <message>
            <source>Cine</source>
            <translation type="unfinished">Ciné</translation>
        </message>
        <message>
            <source>Run through the slices</source>
            <translation type="unfinished">Parcourir les coupes</translation>
        </message>
        <message>
            <source>{rate} slices a second</source>
            <translation type="unfinished">{rate} coupes par seconde</translation>
        </message>
        <message>
            <source>Fit to pane</source>
            <translation type="unfinished">Ajuster à la vue</translation>
        </message>
        <message>
            <source>Reset view</source>
            <translation type="unfinished">Réinitialiser</translation>
        </message>
        <message>
            <source>Space</source>
            <translation type="unfinished">Espace</translation>
        </message>
        <message>
            <source>Maximise or restore</source>
            <translation type="unfinished">Agrandir ou rétablir</translation>
        </message>
        <message>
            <source>{thickness:g} mm</source>
            <translation type="unfinished">{thickness:g} mm</translation>
        </message>
        <message>
            <source>One slice</source>
            <translation type="unfinished">Une coupe</translation>
        </message>
        <message>
            <source>Right by 90°</source>
            <translation type="unfinished">À droite de 90°</translation>
        </message>
        <message>
            <source>Left by 90°</source>
            <translation type="unfinished">À gauche de 90°</translation>
        </message>
        <message>
            <source>By 180°: from the other side of the table</source>
            <translation type="unfinished">De 180° : de l’autre côté de la table</translation>
        </message>
        <message>
            <source>Mirror left-right</source>
            <translation type="unfinished">Miroir gauche-droite</translation>
        </message>
        <message>
            <source>Mirror top-bottom</source>
            <translation type="unfinished">Miroir haut-bas</translation>
        </message>
        <message>
            <source>As radiologists read it</source>
            <translation type="unfinished">Comme le lisent les radiologues</translation>
        </message>
        <message>
            <source>Keep this window</source>
            <translation type="unfinished">Garder ce fenêtrage</translation>
        </message>
        <message>
            <source>Name for W {width:.0f}  L {level:.0f}</source>
            <translation type="unfinished">Nom pour W {width:.0f}  L {level:.0f}</translation>
        </message>
        <message>
            <source>In plane 90°</source>
            <translation type="unfinished">Dans le plan 90°</translation>
        </message>
        <message>
            <source>Probe's eye</source>
            <translation type="unfinished">Vue de la pointe</translation>
        </message>
        <message>
            <source>{kind} {thickness:g} mm</source>
            <translation type="unfinished">{kind} {thickness:g} mm</translation>
        </message>
        <message>
            <source>mirrored</source>
            <translation type="unfinished">en miroir</translation>
        </message>
        <message>
            <source>turned {angle}°</source>
            <translation type="unfinished">tourné de {angle}°</translation>
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
            <translation type="unfinished">Aux pieds du patient</translation>
        </message>
        <message>
            <source>At the patient's head</source>
            <translation type="unfinished">À la tête du patient</translation>
        </message>
        <message>
            <source>On the patient's right</source>
            <translation type="unfinished">À droite du patient</translation>
        </message>
        <message>
            <source>On the patient's left</source>
            <translation type="unfinished">À gauche du patient</translation>
        </message>
        <message>
            <source>Soft tissue</source>
            <translation type="unfinished">Tissus mous</translation>
        </message>
        <message>
            <source>Mediastinum</source>
            <translation type="unfinished">Médiastin</translation>
        </message>
        <message>
            <source>Brain</source>
            <translation type="unfinished">Cerveau</translation>
        </message>
        <message>
            <source>Angio</source>
            <translation type="unfinished">Angio</translation>
        </message>
        <message>
            <source>Spine</source>
            <translation type="unfinished">Rachis</translation>
        </message>
        <message>
            <source>From values</source>
            <translation type="unfinished">D’après les valeurs</translation>
        </message>
        <message>
            <source>From DICOM</source>
            <translation type="unfinished">Du DICOM</translation>
        </message>
        <message>
            <source>the target</source>
            <translation type="unfinished">la cible</translation>
        </message>
        <message>
            <source>the 2nd point</source>
            <translation type="unfinished">le 2e point</translation>
        </message>
        <message>
            <source>the tip</source>
            <translation type="unfinished">la pointe</translation>
        </message>
        <message>
            <source>the path</source>
            <translation type="unfinished">la trajectoire</translation>
        </message>
        <message>
            <source>both points</source>
            <translation type="unfinished">les deux points</translation>
        </message>
        <message>
            <source>the needle</source>
            <translation type="unfinished">l’aiguille</translation>
        </message>
        <message>
            <source>at {place}</source>
            <translation type="unfinished">sur {place}</translation>
        </message>
        <message>
            <source>{distance:.0f} mm ahead of {place}</source>
            <translation type="unfinished">depuis {place}, {distance:.0f} mm en avant</translation>
        </message>
        <message>
            <source>{distance:.0f} mm behind {place}</source>
            <translation type="unfinished">depuis {place}, {distance:.0f} mm en arrière</translation>
        </message>
        <message>
            <source>through {line}</source>
            <translation type="unfinished">par {line}</translation>
        </message>
        <message>
            <source>{distance:.0f} mm {side} of {line}</source>
            <translation type="unfinished">{distance:.0f} mm {side} par rapport à {line}</translation>
        </message>
        <message>
            <source>{step:.2f} mm slices</source>
            <translation type="unfinished">coupes de {step:.2f} mm</translation>
        </message>
        <message>
            <source>W {width:.0f}  L {level:.0f}</source>
            <translation type="unfinished">W {width:.0f}  L {level:.0f}</translation>
        </message>
        <message>
            <source>locked</source>
            <translation type="unfinished">verrouillé</translation>
        </message>
        <message>
            <source>inverted</source>
            <translation type="unfinished">inversé</translation>
        </message>
        <message>
            <source>Zoom {zoom:.1f} px/mm</source>
            <translation type="unfinished">Zoom {zoom:.1f} px/mm</translation>
        </message>
        <message>
            <source>outside the image</source>
            <translation type="unfinished">hors de l’image</translation>
        </message>
        <message>
            <source>{angle:.0f}° oblique</source>
            <translation type="unfinished">oblique {angle:.0f}°</translation>
        </message>
        <message>
            <source>{position} mm</source>
            <translation type="unfinished">{position} mm</translation>
        </message>
        <message>
            <source>Slice {number} / {count}</source>
            <translation type="unfinished">Coupe {number} / {count}</translation>
        </message>
        <message>
            <source>gantry tilt {angle:.1f}°</source>
            <translation type="unfinished">inclinaison du statif {angle:.1f}°</translation>
        </message>
        <message>
            <source>{modality}: no Hounsfield units</source>
            <translation type="unfinished">{modality} : pas d’unités Hounsfield</translation>
        </message>
        <message>
            <source>1st point</source>
            <translation type="unfinished">1er point</translation>
        </message>
        <message>
            <source>2nd point</source>
            <translation type="unfinished">2e point</translation>
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
            <translation type="unfinished">à {depth:.0f} mm de profondeur</translation>
        </message>
        <message>
            <source>at the target</source>
            <translation type="unfinished">à la cible</translation>
        </message>
        <message>
            <source>too deep</source>
            <translation type="unfinished">trop profond</translation>
        </message>
        <message>
            <source>on the path again</source>
            <translation type="unfinished">de nouveau sur la trajectoire</translation>
        </message>
        <message>
            <source>near a structure</source>
            <translation type="unfinished">près d’une structure</translation>
        </message>
        <message>
            <source>the breath rests</source>
            <translation type="unfinished">la respiration est au repos</translation>
        </message>
        <message>
            <source>target touched</source>
            <translation type="unfinished">cible touchée</translation>
        </message>
        <message>
            <source>Sounds</source>
            <translation type="unfinished">Sons</translation>
        </message>
        <message>
            <source>The last announcement, which can also be heard: View, Sounds.</source>
            <translation type="unfinished">La dernière annonce, qui peut aussi s’entendre : Affichage, Sons.</translation>
        </message>
        <message>
            <source>Sounds of the attempt</source>
            <translation type="unfinished">Sons de l’essai</translation>
        </message>
        <message>
            <source>Quiet</source>
            <translation type="unfinished">Faible</translation>
        </message>
        <message>
            <source>Medium</source>
            <translation type="unfinished">Moyen</translation>
        </message>
        <message>
            <source>Loud</source>
            <translation type="unfinished">Fort</translation>
        </message>
        <message>
            <source>Depth every 5 mm, the target, the path, scans, structures, the rest of a breath. Everything that is heard is written in the status strip too.</source>
            <translation type="unfinished">Profondeur tous les 5 mm, cible, trajectoire, scans, structures, repos de la respiration. Tout ce qui s’entend s’affiche aussi dans la barre d’état.</translation>
        </message>
        <message>
            <source>new</source>
            <translation type="unfinished">nouveau</translation>
        </message>
        <message>
            <source>Reading the exercise's structures</source>
            <translation type="unfinished">Lecture des structures de l’exercice</translation>
        </message>
        <message>
            <source>Open structures</source>
            <translation type="unfinished">Ouvrir des structures</translation>
        </message>
        <message>
            <source>Open the CT that the structures belong to first.</source>
            <translation type="unfinished">Ouvrez d’abord le CT auquel appartiennent les structures.</translation>
        </message>
        <message>
            <source>{name}: {count} structures</source>
            <translation type="unfinished">{name} : structures : {count}</translation>
        </message>
        <message>
            <source>Reading structures</source>
            <translation type="unfinished">Lecture des structures</translation>
        </message>
        <message>
            <source>3D Slicer segmentation (*.seg.nrrd);;DICOM SEG (*.dcm)</source>
            <translation type="unfinished">Segmentation 3D Slicer (*.seg.nrrd);;DICOM SEG (*.dcm)</translation>
        </message>
        <message>
            <source>Save structures</source>
            <translation type="unfinished">Enregistrer les structures</translation>
        </message>
        <message>
            <source>Written: {name}</source>
            <translation type="unfinished">Écrit : {name}</translation>
        </message>
        <message>
            <source>Writing structures</source>
            <translation type="unfinished">Écriture des structures</translation>
        </message>
        <message>
            <source>Structures</source>
            <translation type="unfinished">Structures</translation>
        </message>
        <message>
            <source>{low:.0f} to {high:.0f} HU</source>
            <translation type="unfinished">{low:.0f} à {high:.0f} UH</translation>
        </message>
        <message>
            <source>threshold</source>
            <translation type="unfinished">seuil</translation>
        </message>
        <message>
            <source>Threshold</source>
            <translation type="unfinished">Seuil</translation>
        </message>
        <message>
            <source>risk</source>
            <translation type="unfinished">risque</translation>
        </message>
        <message>
            <source>target</source>
            <translation type="unfinished">cible</translation>
        </message>
        <message>
            <source>other</source>
            <translation type="unfinished">autre</translation>
        </message>
        <message>
            <source>{ml:.2f} ml. Tick: drawn. Double click: rename.</source>
            <translation type="unfinished">{ml:.2f} ml. Coche : dessinée. Double clic : renommer.</translation>
        </message>
        <message>
            <source>Kind of {name}</source>
            <translation type="unfinished">Type de {name}</translation>
        </message>
        <message>
            <source>Warning distance of {name}</source>
            <translation type="unfinished">Distance d’alerte de {name}</translation>
        </message>
        <message>
            <source>Warn within so many mm; 0 never</source>
            <translation type="unfinished">Avertir à moins de tant de mm ; 0 jamais</translation>
        </message>
        <message>
            <source>The path comes nearest {depth:.0f} mm behind its entry</source>
            <translation type="unfinished">La trajectoire passe au plus près {depth:.0f} mm après son point d’entrée</translation>
        </message>
        <message>
            <source>Warn
[mm]</source>
            <translation type="unfinished">Alerte
[mm]</translation>
        </message>
        <message>
            <source>Path
[mm]</source>
            <translation type="unfinished">Trajectoire
[mm]</translation>
        </message>
        <message>
            <source>Save…</source>
            <translation type="unfinished">Enregistrer…</translation>
        </message>
        <message>
            <source> HU</source>
            <translation type="unfinished"> UH</translation>
        </message>
        <message>
            <source>Paint only these values</source>
            <translation type="unfinished">Ne peindre que ces valeurs</translation>
        </message>
        <message>
            <source>All of these values in the body</source>
            <translation type="unfinished">Toutes ces valeurs dans le corps</translation>
        </message>
        <message>
            <source>No structures. Open a DICOM SEG, RTSTRUCT, .seg.nrrd or NIfTI label file, or mark one with the brush.</source>
            <translation type="unfinished">Aucune structure. Ouvrez un DICOM SEG, un RTSTRUCT, un fichier .seg.nrrd ou d’étiquettes NIfTI, ou marquez-en une au pinceau.</translation>
        </message>
        <message>
            <source>Mark the chosen one, or a new one</source>
            <translation type="unfinished">Marquer celle choisie, ou une nouvelle</translation>
        </message>
        <message>
            <source>Radius</source>
            <translation type="unfinished">Rayon</translation>
        </message>
        <message>
            <source>From</source>
            <translation type="unfinished">De</translation>
        </message>
        <message>
            <source>To</source>
            <translation type="unfinished">À</translation>
        </message>
        <message>
            <source>● Paint</source>
            <translation type="unfinished">● Peindre</translation>
        </message>
        <message>
            <source>○ Erase</source>
            <translation type="unfinished">○ Gommer</translation>
        </message>
        <message>
            <source>✱ Grow</source>
            <translation type="unfinished">✱ Étendre</translation>
        </message>
        <message>
            <source>Smallest distance between the needle and a structure that warns. The Structures panel lists distances and kinds.</source>
            <translation type="unfinished">Plus petite distance entre l’aiguille et une structure qui avertit. Le panneau Structures donne distances et types.</translation>
        </message>
        <message>
            <source>clear</source>
            <translation type="unfinished">libre</translation>
        </message>
        <message>
            <source>needle in {name}, {depth:.1f} mm deep</source>
            <translation type="unfinished">aiguille dans {name}, à {depth:.1f} mm de profondeur</translation>
        </message>
        <message>
            <source>{distance:.1f} mm from {name}</source>
            <translation type="unfinished">à {distance:.1f} mm de {name}</translation>
        </message>
        <message>
            <source>A bevelled tip cuts a curved path</source>
            <translation type="unfinished">Une pointe biseautée coupe un chemin courbe</translation>
        </message>
        <message>
            <source>A branch of the hepatic vein passes 7 mm beside the path, 1 cm before the lesion. Find it in the slices before you begin: it is drawn on them and in 3D. Keep the needle at least 5 mm off it, tip and shaft, all the way; a degree and a half towards it at depth is too much, and a needle that is turned deep sweeps nearer than one that was aimed right. The patient holds the breath.</source>
            <translation type="unfinished">Une branche de la veine hépatique passe à 7 mm de la trajectoire, 1 cm avant la lésion. Repérez-la dans les coupes avant de commencer : elle y est tracée, ainsi qu’en 3D. Gardez l’aiguille à 5 mm d’elle au moins, pointe et tige, tout du long ; un degré et demi vers elle, en profondeur, c’est trop, et une aiguille que l’on tourne une fois profonde balaie plus près qu’une aiguille bien orientée dès le départ. Le patient retient sa respiration.</translation>
        </message>
        <message>
            <source>A holder over the skin turns its guide to the planned path and holds it with four cables; slide the needle to the lesion, hold, and end the attempt. The patient holds the breath. With the dial below zero it pushes the needle away. Whatever fails in it ends the force, and is said.</source>
            <translation type="unfinished">Un porte-aiguille au-dessus de la peau tourne son guide vers la trajectoire planifiée et le tient par quatre câbles ; faites glisser l’aiguille jusqu’à la lésion, restez immobile, puis terminez l’essai. Le patient retient sa respiration. Avec le réglage sous zéro, le porte-aiguille repousse l’aiguille. Toute panne du porte-aiguille coupe la force et est signalée.</translation>
        </message>
        <message>
            <source>A large vessel runs along the path, 2 cm beside it. There is hardly any guidance; the robot pushes the needle aside when it is about to reach the vessel, and back before it leans too far. A needle that meets the vessel or a rib fails. The patient holds the breath.</source>
            <translation type="unfinished">Un gros vaisseau longe la trajectoire, à 2 cm. Il n’y a presque pas de guidage ; le robot écarte l’aiguille quand elle est sur le point d’atteindre le vaisseau, et la ramène avant qu’elle ne s’incline trop. Si l’aiguille rencontre le vaisseau ou une côte, l’essai est échoué. Le patient retient sa respiration.</translation>
        </message>
        <message>
            <source>A nodule of 1 cm lies in the right lung. The path runs between two ribs, 28° from the right and 16° from below, so no axial slice shows it whole: follow it in the oblique planes along the needle, or slice by slice. Align exactly before the skin. A rib stops the needle, and touching one fails. Lung gives way: once inside, it hardly holds the needle on its path. The nodule moves a little with every breath: go in while it rests at the end of exhalation.</source>
            <translation type="unfinished">Un nodule de 1 cm se trouve dans le poumon droit. La trajectoire passe entre deux côtes, à 28° depuis la droite et 16° depuis le bas, si bien qu’aucune coupe axiale ne la montre en entier : suivez-la dans les plans obliques le long de l’aiguille, ou coupe par coupe. Alignez exactement avant la peau. Une côte arrête l’aiguille, et en toucher une fait échouer. Le poumon cède : une fois dedans, il maintient à peine l’aiguille sur sa trajectoire. Le nodule bouge un peu à chaque respiration : entrez pendant qu’il est au repos, en fin d’expiration.</translation>
        </message>
        <message>
            <source>A pen with printed markers before a webcam</source>
            <translation type="unfinished">Un stylo à marqueurs imprimés devant une webcam</translation>
        </message>
        <message>
            <source>A pen with printed markers before one webcam</source>
            <translation type="unfinished">Un stylo à marqueurs imprimés devant une seule webcam</translation>
        </message>
        <message>
            <source>A simulated arm carries out the plan</source>
            <translation type="unfinished">Un bras simulé exécute le plan</translation>
        </message>
        <message>
            <source>Adversary: attempts that are paid and ought not to be</source>
            <translation type="unfinished">Adversaire : essais récompensés qui ne devraient pas l’être</translation>
        </message>
        <message>
            <source>Aerated lung crossed</source>
            <translation type="unfinished">Poumon aéré traversé</translation>
        </message>
        <message>
            <source>Against repulsion</source>
            <translation type="unfinished">Contre la répulsion</translation>
        </message>
        <message>
            <source>Align the needle with the planned path, insert it to the lesion, hold, and end the attempt. The robot guides strongly; the patient holds the breath.</source>
            <translation type="unfinished">Alignez l’aiguille sur la trajectoire planifiée, introduisez-la jusqu’à la lésion, restez immobile et terminez l’essai. Le robot guide fortement ; le patient retient sa respiration.</translation>
        </message>
        <message>
            <source>Aligning time</source>
            <translation type="unfinished">Temps d’alignement</translation>
        </message>
        <message>
            <source>All</source>
            <translation type="unfinished">Tous</translation>
        </message>
        <message>
            <source>Angle error at the skin</source>
            <translation type="unfinished">Erreur d’angle à la peau</translation>
        </message>
        <message>
            <source>Angle error in plane</source>
            <translation type="unfinished">Erreur d’angle dans le plan</translation>
        </message>
        <message>
            <source>Angle error out of plane</source>
            <translation type="unfinished">Erreur d’angle hors du plan</translation>
        </message>
        <message>
            <source>Archives and DICOM files</source>
            <translation type="unfinished">Archives et fichiers DICOM</translation>
        </message>
        <message>
            <source>Beside the vein</source>
            <translation type="unfinished">À côté de la veine</translation>
        </message>
        <message>
            <source>Bone contacts</source>
            <translation type="unfinished">Contacts avec l’os</translation>
        </message>
        <message>
            <source>Bone turns the tip aside</source>
            <translation type="unfinished">L’os dévie la pointe</translation>
        </message>
        <message>
            <source>Breath while pushing</source>
            <translation type="unfinished">Respiration en avançant</translation>
        </message>
        <message>
            <source>Breathing liver</source>
            <translation type="unfinished">Foie qui respire</translation>
        </message>
        <message>
            <source>Breathing moves the target</source>
            <translation type="unfinished">La respiration déplace la cible</translation>
        </message>
        <message>
            <source>Cameras are out of focus or shake</source>
            <translation type="unfinished">Caméras floues ou qui tremblent</translation>
        </message>
        <message>
            <source>Cameras count photons and apply a tone curve</source>
            <translation type="unfinished">Les caméras comptent les photons et appliquent une courbe tonale</translation>
        </message>
        <message>
            <source>Cameras deliver JPEG</source>
            <translation type="unfinished">Les caméras fournissent du JPEG</translation>
        </message>
        <message>
            <source>Cameras lose pictures</source>
            <translation type="unfinished">Les caméras perdent des images</translation>
        </message>
        <message>
            <source>Centre of an ellipse through the contour on rays</source>
            <translation type="unfinished">Centre d’une ellipse par le contour sur des rayons</translation>
        </message>
        <message>
            <source>Certificates</source>
            <translation type="unfinished">Certificats</translation>
        </message>
        <message>
            <source>Compensation of gravity and joint friction</source>
            <translation type="unfinished">Compensation de la gravité et du frottement articulaire</translation>
        </message>
        <message>
            <source>Contact of the tip with bone</source>
            <translation type="unfinished">Contact de la pointe avec l’os</translation>
        </message>
        <message>
            <source>Contact: exact hold, midpoint, backward, symplectic, Runge-Kutta, explicit</source>
            <translation type="unfinished">Contact : bloqueur exact, point milieu, rétrograde, symplectique, Runge-Kutta, explicite</translation>
        </message>
        <message>
            <source>Control scans only (assessment)</source>
            <translation type="unfinished">Scans de contrôle seuls (évaluation)</translation>
        </message>
        <message>
            <source>Corners of a board: the window that refines them, by square, slant, edge and noise</source>
            <translation type="unfinished">Coins d’une mire : la fenêtre qui les affine, selon case, obliquité, bord et bruit</translation>
        </message>
        <message>
            <source>Coverage: stated errors of calibration, pose, tip and registration</source>
            <translation type="unfinished">Couverture : erreurs annoncées d’étalonnage, de pose, de pointe et de recalage</translation>
        </message>
        <message>
            <source>Cutting of the tissue at the tip</source>
            <translation type="unfinished">Coupe du tissu à la pointe</translation>
        </message>
        <message>
            <source>Depth error</source>
            <translation type="unfinished">Erreur de profondeur</translation>
        </message>
        <message>
            <source>Dimpling and puncture of skin, fascia and capsule</source>
            <translation type="unfinished">Enfoncement et perforation de la peau, du fascia et de la capsule</translation>
        </message>
        <message>
            <source>Direction held by the robot</source>
            <translation type="unfinished">Direction tenue par le robot</translation>
        </message>
        <message>
            <source>Distance from risk</source>
            <translation type="unfinished">Distance à la structure à risque</translation>
        </message>
        <message>
            <source>Dose (teaching estimate)</source>
            <translation type="unfinished">Dose (estimation pédagogique)</translation>
        </message>
        <message>
            <source>Economy of motion</source>
            <translation type="unfinished">Économie de mouvement</translation>
        </message>
        <message>
            <source>Entries that planning help tries: how many find the best path</source>
            <translation type="unfinished">Points d’entrée que l’aide à la planification essaie : combien trouvent la meilleure trajectoire</translation>
        </message>
        <message>
            <source>Error to the planned target</source>
            <translation type="unfinished">Erreur à la cible planifiée</translation>
        </message>
        <message>
            <source>Fat and muscle are thick and stiff. Correct the angle while the needle is shallow: the tissue resists with the cube of the depth. The patient holds the breath.</source>
            <translation type="unfinished">La graisse et le muscle sont épais et raides. Corrigez l’angle tant que l’aiguille est peu profonde : le tissu résiste avec le cube de la profondeur. Le patient retient sa respiration.</translation>
        </message>
        <message>
            <source>First insertion</source>
            <translation type="unfinished">Première ponction</translation>
        </message>
        <message>
            <source>Force at its limit</source>
            <translation type="unfinished">Force à sa limite</translation>
        </message>
        <message>
            <source>Force at the hand: printed law and virtual work against closed-loop statics</source>
            <translation type="unfinished">Force à la main : loi imprimée et travail virtuel face à la statique en boucle fermée</translation>
        </message>
        <message>
            <source>Force on bone</source>
            <translation type="unfinished">Force sur l’os</translation>
        </message>
        <message>
            <source>Friction along the needle: Kikuuwe, Dahl, LuGre, and the sign of the speed</source>
            <translation type="unfinished">Frottement le long de l’aiguille : Kikuuwe, Dahl, LuGre, et le signe de la vitesse</translation>
        </message>
        <message>
            <source>Friction and play of the ball joints</source>
            <translation type="unfinished">Frottement et jeu des rotules</translation>
        </message>
        <message>
            <source>Friction of the tissue along the inserted shaft</source>
            <translation type="unfinished">Frottement du tissu le long de la tige introduite</translation>
        </message>
        <message>
            <source>Fréchet distance from the path</source>
            <translation type="unfinished">Distance de Fréchet à la trajectoire</translation>
        </message>
        <message>
            <source>Grasp: closed form, convex hull, linear programmes, directions tried</source>
            <translation type="unfinished">Prise : forme close, enveloppe convexe, programmes linéaires, directions essayées</translation>
        </message>
        <message>
            <source>Guidance work</source>
            <translation type="unfinished">Travail du guidage</translation>
        </message>
        <message>
            <source>Gut touched</source>
            <translation type="unfinished">Intestin touché</translation>
        </message>
        <message>
            <source>Hard cases: every subsystem where its formulas are delicate</source>
            <translation type="unfinished">Cas difficiles : chaque sous-système là où ses formules sont délicates</translation>
        </message>
        <message>
            <source>Hold the breath</source>
            <translation type="unfinished">Demander l’apnée</translation>
        </message>
        <message>
            <source>Holding time</source>
            <translation type="unfinished">Temps de maintien</translation>
        </message>
        <message>
            <source>Impedance at the tool point: virtual mass, spring and damper</source>
            <translation type="unfinished">Impédance au point d’outil : masse, ressort et amortisseur virtuels</translation>
        </message>
        <message>
            <source>Insertion time</source>
            <translation type="unfinished">Temps de ponction</translation>
        </message>
        <message>
            <source>Inverse kinematics of the arm: closed forms, damped least squares, other programs</source>
            <translation type="unfinished">Cinématique inverse du bras : formes closes, moindres carrés amortis, autres programmes</translation>
        </message>
        <message>
            <source>Inverse kinematics of the pantograph: closed form, Newton, table</source>
            <translation type="unfinished">Cinématique inverse du pantographe : forme close, Newton, table</translation>
        </message>
        <message>
            <source>Kidney from behind</source>
            <translation type="unfinished">Rein par l’arrière</translation>
        </message>
        <message>
            <source>Laparoscopic tool</source>
            <translation type="unfinished">Instrument laparoscopique</translation>
        </message>
        <message>
            <source>Lateral tissue: rigid needle on springs against a beam on an elastic foundation</source>
            <translation type="unfinished">Tissu latéral : aiguille rigide sur ressorts face à une poutre sur fondation élastique</translation>
        </message>
        <message>
            <source>Least squares of the band's whole picture</source>
            <translation type="unfinished">Moindres carrés sur toute l’image de la bande</translation>
        </message>
        <message>
            <source>Letting go of the needle: force to be had against run-away</source>
            <translation type="unfinished">Lâcher l’aiguille : force disponible face à l’emballement</translation>
        </message>
        <message>
            <source>Light before the cameras</source>
            <translation type="unfinished">Lumière devant les caméras</translation>
        </message>
        <message>
            <source>Lung, oblique twice between ribs</source>
            <translation type="unfinished">Poumon, double oblique entre les côtes</translation>
        </message>
        <message>
            <source>Mask, then the centroid of the covered shares</source>
            <translation type="unfinished">Masque, puis le barycentre des parts couvertes</translation>
        </message>
        <message>
            <source>Mean distance from the path (DTW)</source>
            <translation type="unfinished">Distance moyenne à la trajectoire (DTW)</translation>
        </message>
        <message>
            <source>Mean force, estimated</source>
            <translation type="unfinished">Force moyenne, estimée</translation>
        </message>
        <message>
            <source>Metrics against what is published of them</source>
            <translation type="unfinished">Indicateurs face à ce qui en est publié</translation>
        </message>
        <message>
            <source>Motion at a trocar</source>
            <translation type="unfinished">Mouvement à un trocart</translation>
        </message>
        <message>
            <source>Oblique slices: nearest, trilinear, cubic</source>
            <translation type="unfinished">Coupes obliques : plus proche voisin, trilinéaire, cubique</translation>
        </message>
        <message>
            <source>Open at half size</source>
            <translation type="unfinished">Ouvrir à demi-taille</translation>
        </message>
        <message>
            <source>Open resampled</source>
            <translation type="unfinished">Ouvrir rééchantillonné</translation>
        </message>
        <message>
            <source>Open straightened</source>
            <translation type="unfinished">Ouvrir redressé</translation>
        </message>
        <message>
            <source>Other organs crossed</source>
            <translation type="unfinished">Autres organes traversés</translation>
        </message>
        <message>
            <source>Passes through a capsule</source>
            <translation type="unfinished">Passages d’une capsule</translation>
        </message>
        <message>
            <source>Passes through the skin</source>
            <translation type="unfinished">Passages de la peau</translation>
        </message>
        <message>
            <source>Past the vessel</source>
            <translation type="unfinished">Le long du vaisseau</translation>
        </message>
        <message>
            <source>Path length</source>
            <translation type="unfinished">Longueur du trajet</translation>
        </message>
        <message>
            <source>Path length, raw</source>
            <translation type="unfinished">Longueur du trajet, brute</translation>
        </message>
        <message>
            <source>Path ratio</source>
            <translation type="unfinished">Rapport du trajet</translation>
        </message>
        <message>
            <source>Peak force, estimated</source>
            <translation type="unfinished">Force maximale, estimée</translation>
        </message>
        <message>
            <source>Pleural angle</source>
            <translation type="unfinished">Angle à la plèvre</translation>
        </message>
        <message>
            <source>Pleural crossings</source>
            <translation type="unfinished">Passages de la plèvre</translation>
        </message>
        <message>
            <source>Pose and tip of the pen</source>
            <translation type="unfinished">Pose et pointe du stylo</translation>
        </message>
        <message>
            <source>Published: needles in tissue, measured and ours</source>
            <translation type="unfinished">Publié : aiguilles dans le tissu, mesures et nôtres</translation>
        </message>
        <message>
            <source>Q, E in the pad turn it</source>
            <translation type="unfinished">Q, E dans la zone la tournent</translation>
        </message>
        <message>
            <source>Rate of the recorded path</source>
            <translation type="unfinished">Cadence du trajet enregistré</translation>
        </message>
        <message>
            <source>Read the planning CT, align the needle by the plan and take control scans where you would in the scanner room: choose table position and 3 to 5 slices, press the pedal (S). A tip outside the slices is not seen. There is no other view of the needle and no guidance by the robot. Use few scans. The patient holds the breath.</source>
            <translation type="unfinished">Lisez le CT de planification, alignez l’aiguille selon le plan et faites des scans de contrôle là où vous les feriez en salle de scanner : choisissez la position de la table et 3 à 5 coupes, appuyez sur la pédale (S). Une pointe hors des coupes ne se voit pas. Il n’y a pas d’autre vue de l’aiguille, et le robot ne guide pas. Faites peu de scans. Le patient retient sa respiration.</translation>
        </message>
        <message>
            <source>Reading DICOM: Acus against GDCM through SimpleITK</source>
            <translation type="unfinished">Lecture DICOM : Acus face à GDCM par SimpleITK</translation>
        </message>
        <message>
            <source>Redirects</source>
            <translation type="unfinished">Réorientations</translation>
        </message>
        <message>
            <source>Region that the needle must not enter</source>
            <translation type="unfinished">Région où l’aiguille ne doit pas entrer</translation>
        </message>
        <message>
            <source>Relaxation of dimpled tissue</source>
            <translation type="unfinished">Relâchement du tissu enfoncé</translation>
        </message>
        <message>
            <source>Side stiffness of layered tissue about the fulcrum</source>
            <translation type="unfinished">Raideur latérale du tissu en couches autour du point de pivot</translation>
        </message>
        <message>
            <source>Smoothness (LDLJ)</source>
            <translation type="unfinished">Fluidité (LDLJ)</translation>
        </message>
        <message>
            <source>Smoothness (SPARC)</source>
            <translation type="unfinished">Fluidité (SPARC)</translation>
        </message>
        <message>
            <source>Smoothness: rate of the sampled speed</source>
            <translation type="unfinished">Fluidité : cadence de la vitesse échantillonnée</translation>
        </message>
        <message>
            <source>Stable (K, B) of the free device over rate and delay</source>
            <translation type="unfinished">(K, B) stables de l’appareil libre selon cadence et retard</translation>
        </message>
        <message>
            <source>Substeps of the simulated robot</source>
            <translation type="unfinished">Sous-pas du robot simulé</translation>
        </message>
        <message>
            <source>Surfaces of the 3D view: resolution of the grid against time</source>
            <translation type="unfinished">Surfaces de la vue 3D : résolution de la grille face au temps</translation>
        </message>
        <message>
            <source>Target error</source>
            <translation type="unfinished">Erreur à la cible</translation>
        </message>
        <message>
            <source>Targets touched</source>
            <translation type="unfinished">Cibles touchées</translation>
        </message>
        <message>
            <source>The arm inserts its tool by pictures alone: success, failures and errors</source>
            <translation type="unfinished">Le bras introduit son instrument par les seules images : réussite, échecs et erreurs</translation>
        </message>
        <message>
            <source>The arm with its hand and its long tool</source>
            <translation type="unfinished">Le bras avec sa main et son long instrument</translation>
        </message>
        <message>
            <source>The arm's kinematics</source>
            <translation type="unfinished">La cinématique du bras</translation>
        </message>
        <message>
            <source>The arm's motion: planner and budget against success and length</source>
            <translation type="unfinished">Le mouvement du bras : planificateur et budget face à réussite et longueur</translation>
        </message>
        <message>
            <source>The fulcrum from pictures: motion of the shaft, or the trocar itself</source>
            <translation type="unfinished">Le point de pivot par les images : mouvement de la tige, ou le trocart lui-même</translation>
        </message>
        <message>
            <source>The laboratory's published detection</source>
            <translation type="unfinished">La détection publiée du laboratoire</translation>
        </message>
        <message>
            <source>The lesion moves with every breath, mostly towards the feet and back. Watch the motion, insert during the rest at the end of exhalation, and end the attempt with the tip in the lesion. A needle in the liver is dragged along with it.</source>
            <translation type="unfinished">La lésion bouge à chaque respiration, surtout vers les pieds et vers l’arrière. Observez le mouvement, introduisez l’aiguille pendant le repos en fin d’expiration, et terminez l’essai avec la pointe dans la lésion. Une aiguille dans le foie est entraînée avec lui.</translation>
        </message>
        <message>
            <source>The lesion moves with every breath. Tell the patient to hold (key A, or the button): he breathes in and out once more and holds. Look where the lesion lies now, for no two holds have it at the same place; aim there, insert, end the attempt while he holds. After 20 s he has to breathe; let him breathe in between, then hold again.</source>
            <translation type="unfinished">La lésion bouge à chaque respiration. Demandez l’apnée au patient (touche A, ou le bouton) : il inspire et expire encore une fois, puis retient sa respiration. Regardez où est maintenant la lésion, car d’une apnée à l’autre elle n’est jamais au même endroit ; visez là, introduisez l’aiguille, terminez l’essai pendant l’apnée. Après 20 s il doit respirer ; laissez-le respirer entre-temps, puis redemandez l’apnée.</translation>
        </message>
        <message>
            <source>The machines side by side: workspace, resolution, stiffness, force, effort, cost</source>
            <translation type="unfinished">Les machines côte à côte : espace de travail, résolution, raideur, force, effort, coût</translation>
        </message>
        <message>
            <source>The marker in a picture: four extractors and two Cramér-Rao bounds</source>
            <translation type="unfinished">Le marqueur dans une image : quatre extracteurs et deux bornes de Cramér-Rao</translation>
        </message>
        <message>
            <source>The pantograph's formulas: closure, and the errors of the printed ones</source>
            <translation type="unfinished">Les formules du pantographe : fermeture, et les erreurs de celles imprimées</translation>
        </message>
        <message>
            <source>The patient lies on the belly. The target is the parenchyma of the left kidney's lower half; the path comes from the flank, below the ribs, and leans to both sides of the axial plane. Check in three planes where it runs, align before you push, and hold the angle through the muscle of the back: it is stiffer than the fat behind the kidney. The kidney moves with every breath, mostly towards the feet: go in while it rests at the end of exhalation.</source>
            <translation type="unfinished">Le patient est couché sur le ventre. La cible est le parenchyme de la moitié inférieure du rein gauche ; la trajectoire vient du flanc, sous les côtes, et s’incline des deux côtés du plan axial. Vérifiez dans trois plans où elle passe, alignez avant de pousser, et tenez l’angle à travers le muscle du dos : il est plus raide que la graisse derrière le rein. Le rein bouge à chaque respiration, surtout vers les pieds : entrez pendant qu’il est au repos, en fin d’expiration.</translation>
        </message>
        <message>
            <source>The robot guides strongly at first; the patient holds the breath. Each good attempt lowers its help by a step, each poor one raises it again. Every fourth attempt is a probe: no force guides you, and neither overlay nor bull's-eye shows the needle. Read the path on the CT beforehand, align by the slices and the robot in space, and feel how deep you are.</source>
            <translation type="unfinished">Le robot guide d’abord fortement ; le patient retient sa respiration. Chaque bon essai baisse son aide d’un pas, chaque mauvais le relève. Un essai sur quatre est un essai témoin : aucune force ne vous guide, et ni la superposition ni la cible de visée ne montrent l’aiguille. Lisez d’avance la trajectoire sur le CT, alignez d’après les coupes et le robot dans l’espace, et sentez à quelle profondeur vous êtes.</translation>
        </message>
        <message>
            <source>The robot pushes the needle off the planned path, gently. Hold it on the path by small, early corrections; exactly on the path there is no force. If you give way, the push fades. The patient holds the breath.</source>
            <translation type="unfinished">Le robot repousse l’aiguille hors de la trajectoire planifiée, doucement. Maintenez-la sur la trajectoire par de petites corrections précoces ; exactement sur la trajectoire, il n’y a pas de force. Si vous cédez, la poussée s’estompe. Le patient retient sa respiration.</translation>
        </message>
        <message>
            <source>The target gives way to the needle</source>
            <translation type="unfinished">La cible cède devant l’aiguille</translation>
        </message>
        <message>
            <source>The target is the lesion in the liver. Find an entry from which a straight path meets neither rib nor lung nor vessel and that the robot can follow, place it (E, or the map of entries in the panel Plan), then insert the needle along your own path. A rib stops the needle; meeting one, or lung, gut or a large vessel, fails. The patient holds the breath.</source>
            <translation type="unfinished">La cible est la lésion du foie. Trouvez un point d’entrée d’où une trajectoire droite ne rencontre ni côte, ni poumon, ni vaisseau, et que le robot peut suivre ; placez-le (E, ou la carte des points d’entrée dans le panneau Plan), puis introduisez l’aiguille le long de votre propre trajectoire. Une côte arrête l’aiguille ; en rencontrer une, ou le poumon, l’intestin ou un gros vaisseau, fait échouer. Le patient retient sa respiration.</translation>
        </message>
        <message>
            <source>The tensegrity needle holder: workspace, closure, conditioning, stiffness, encoders</source>
            <translation type="unfinished">Le porte-aiguille en tenségrité : espace de travail, fermeture, conditionnement, raideur, codeurs</translation>
        </message>
        <message>
            <source>The tip on the screen: newest fix, Kalman, one euro</source>
            <translation type="unfinished">La pointe à l’écran : dernière mesure, Kalman, one euro</translation>
        </message>
        <message>
            <source>The tool and the trocar in pictures</source>
            <translation type="unfinished">L’instrument et le trocart dans les images</translation>
        </message>
        <message>
            <source>The waveform of breathing: product, power, table, sum of cosines</source>
            <translation type="unfinished">La forme d’onde de la respiration : produit, puissance, table, somme de cosinus</translation>
        </message>
        <message>
            <source>Thick tissue</source>
            <translation type="unfinished">Tissu épais</translation>
        </message>
        <message>
            <source>Through the cable-driven holder</source>
            <translation type="unfinished">À travers le porte-aiguille à câbles</translation>
        </message>
        <message>
            <source>Time inside risk</source>
            <translation type="unfinished">Temps dans une structure à risque</translation>
        </message>
        <message>
            <source>Time per target</source>
            <translation type="unfinished">Temps par cible</translation>
        </message>
        <message>
            <source>Tissue at the tip, from the patient's field</source>
            <translation type="unfinished">Tissu à la pointe, d’après le champ de tissus du patient</translation>
        </message>
        <message>
            <source>Tissue: layers along the plan against fields of labels in the patient</source>
            <translation type="unfinished">Tissu : couches le long du plan face aux champs d’étiquettes dans le patient</translation>
        </message>
        <message>
            <source>Too near to risk</source>
            <translation type="unfinished">Trop près d’une structure à risque</translation>
        </message>
        <message>
            <source>Total time</source>
            <translation type="unfinished">Temps total</translation>
        </message>
        <message>
            <source>Tracking valid</source>
            <translation type="unfinished">Suivi valide</translation>
        </message>
        <message>
            <source>Transforms</source>
            <translation type="unfinished">Transformations</translation>
        </message>
        <message>
            <source>Trials: the loop alone, a trainer, a trainer with rendered pictures</source>
            <translation type="unfinished">Tests : la boucle de commande seule, un simulateur, un simulateur avec images de synthèse</translation>
        </message>
        <message>
            <source>Triangulation: three ways, and figure 42 redone</source>
            <translation type="unfinished">Triangulation : trois méthodes, et la figure 42 refaite</translation>
        </message>
        <message>
            <source>Velocity from encoder angles</source>
            <translation type="unfinished">Vitesse d’après les angles des codeurs</translation>
        </message>
        <message>
            <source>Vessels touched</source>
            <translation type="unfinished">Vaisseaux touchés</translation>
        </message>
        <message>
            <source>Views of a board that calibrate a camera</source>
            <translation type="unfinished">Vues d’une mire qui étalonnent une caméra</translation>
        </message>
        <message>
            <source>Virtual fixture: guides to the path or repels from it</source>
            <translation type="unfinished">Guide virtuel : guide vers la trajectoire ou en repousse</translation>
        </message>
        <message>
            <source>Wall before the tilt limit</source>
            <translation type="unfinished">Mur avant la limite d’inclinaison</translation>
        </message>
        <message>
            <source>With less and less help</source>
            <translation type="unfinished">Avec de moins en moins d’aide</translation>
        </message>
        <message>
            <source>You hold the handle of a long tool that goes through a trocar. Move the handle to the left and the tip goes to the right, the further the deeper it is. Touch the numbered targets one after the other: bring the tip onto the target that is marked, and hold it there until the next one is. Go straight to each; press Enter after the last.</source>
            <translation type="unfinished">Vous tenez la poignée d’un long instrument qui passe par un trocart. Déplacez la poignée vers la gauche et la pointe va vers la droite, d’autant plus loin qu’elle est profonde. Touchez les cibles numérotées l’une après l’autre : amenez la pointe sur la cible marquée et maintenez-la là jusqu’à ce que la suivante le soit. Allez tout droit à chacune ; appuyez sur Entrée après la dernière.</translation>
        </message>
        <message>
            <source>Align only: it ends as the tip goes through the skin, and only the tilt there counts.</source>
            <translation type="unfinished">Alignement seul : l’essai se termine quand la pointe traverse la peau, et seule l’inclinaison à cet endroit compte.</translation>
        </message>
        <message>
            <source>Depth only: you begin aligned, and only the depth counts.</source>
            <translation type="unfinished">Profondeur seule : vous commencez avec l’aiguille alignée, et seule la profondeur compte.</translation>
        </message>
        <message>
            <source>Breath only: push while the target is in its place, wait while it is not; nothing else counts.</source>
            <translation type="unfinished">Respiration seule : avancez quand la cible est à sa place, attendez quand elle n’y est pas ; rien d’autre ne compte.</translation>
        </message>
        <message>
            <source>Ten times three minutes: the whole exercise; each round ends by itself after three minutes.</source>
            <translation type="unfinished">Dix fois trois minutes : l’exercice entier ; chaque tour se termine de lui-même après trois minutes.</translation>
        </message>
        <message>
            <source>the field: {because}</source>
            <translation type="unfinished">le champ : {because}</translation>
        </message>
        <message>
            <source>layers: {because}</source>
            <translation type="unfinished">couches : {because}</translation>
        </message>
        <message>
            <source>a needle {angle:.0f}° from upright</source>
            <translation type="unfinished">une aiguille à {angle:.0f}° de la verticale</translation>
        </message>
        <message>
            <source>{where} meets {name} at {begin_mm:.0f} mm, which the path does not</source>
            <translation type="unfinished">{where} rencontre {name} à {begin_mm:.0f} mm, et la trajectoire non</translation>
        </message>
        <message>
            <source>{where} meets {others}, the path {own}</source>
            <translation type="unfinished">{where} rencontre {others}, la trajectoire {own}</translation>
        </message>
        <message>
            <source>{where} feels {most:.1f} N more or less at {depth:.0f} mm than the path</source>
            <translation type="unfinished">{where} ressent à {depth:.0f} mm {most:.1f} N de plus ou de moins que la trajectoire</translation>
        </message>
        <message>
            <source>every needle within reach meets {names} with the same force to {most:.2f} N</source>
            <translation type="unfinished">toute aiguille à portée rencontre {names}, avec la même force à {most:.2f} N près</translation>
        </message>
        <message>
            <source>the breath does not move the target</source>
            <translation type="unfinished">la respiration ne déplace pas la cible</translation>
        </message>
        <message>
            <source>the needle was never pushed deeper</source>
            <translation type="unfinished">l’aiguille n’a jamais été avancée plus profond</translation>
        </message>
        <message>
            <source>a hand's unsteadiness needs finite numbers of 0 or more, and a lag and a memory above 0, got {this}</source>
            <translation type="unfinished">l’instabilité d’une main demande des nombres finis d’au moins 0, et un retard et une mémoire au-dessus de 0 ; reçu : {this}</translation>
        </message>
        <message>
            <source>Breath</source>
            <translation type="unfinished">Respiration</translation>
        </message>
        <message>
            <source>How far the breath has moved the target from where the CT has it. In the band it is within the inner ring: push there, wait elsewhere.</source>
            <translation type="unfinished">De combien la respiration a déplacé la cible par rapport au CT. Dans la bande, elle est dans l’anneau intérieur : avancez là, attendez ailleurs.</translation>
        </message>
        <message>
            <source>✔ at rest: push</source>
            <translation type="unfinished">✔ au repos : avancer</translation>
        </message>
        <message>
            <source>▲ {mm:.0f} mm away: wait</source>
            <translation type="unfinished">▲ à {mm:.0f} mm : attendre</translation>
        </message>
        <message>
            <source>Click: this slice alone, with all that a slice can do</source>
            <translation type="unfinished">Clic : cette coupe seule, avec tout ce que permet une coupe</translation>
        </message>
        <message>
            <source>Technician</source>
            <translation type="unfinished">Technicien</translation>
        </message>
        <message>
            <source>practise, progress, help</source>
            <translation type="unfinished">s’exercer, progrès, aide</translation>
        </message>
        <message>
            <source>also patients, exercises, courses and results</source>
            <translation type="unfinished">en plus patients, exercices, cours et résultats</translation>
        </message>
        <message>
            <source>also robot, cameras, checks, effects and cost of accuracy</source>
            <translation type="unfinished">en plus robot, caméras, vérifications, effets et coût de la précision</translation>
        </message>
        <message>
            <source>Put panels away ({key})</source>
            <translation type="unfinished">Masquer les panneaux ({key})</translation>
        </message>
        <message>
            <source>All panels ({key})</source>
            <translation type="unfinished">Tous les panneaux ({key})</translation>
        </message>
        <message>
            <source>Live pictures ({key})</source>
            <translation type="unfinished">Images en direct ({key})</translation>
        </message>
        <message>
            <source>Control scan again ({key})</source>
            <translation type="unfinished">Revoir le scan de contrôle ({key})</translation>
        </message>
        <message>
            <source>Role</source>
            <translation type="unfinished">Rôle</translation>
        </message>
        <message>
            <source>An attempt is running: end it before the role is changed</source>
            <translation type="unfinished">Un essai est en cours : terminez-le avant de changer de rôle</translation>
        </message>
        <message>
            <source>Role: {role}</source>
            <translation type="unfinished">Rôle : {role}</translation>
        </message>
        <message>
            <source>Who sits here: it decides what the window has ({key})</source>
            <translation type="unfinished">Qui est ici : cela décide de ce que contient la fenêtre ({key})</translation>
        </message>
        <message>
            <source>Go on to the attempt</source>
            <translation type="unfinished">Passer à l’essai</translation>
        </message>
        <message>
            <source>Back to the plan</source>
            <translation type="unfinished">Retour au plan</translation>
        </message>
    </context>
</TS>
