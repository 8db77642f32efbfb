within ContactMultiBody.Types;
type Friction = enumeration(
    None "No friction: forces act along the normals",
    Regularised "Coulomb friction, continuous through zero speed; no states, creeps under load",
    Anchored "Friction with static springs; six states a pair, holds without creeping") "Friction between bodies"
  annotation (Documentation(info="<html>
<p>How tangential forces are computed; see the package <a href=\"modelica://ContactMultiBody.Friction\">Friction</a>.</p>
</html>"));
